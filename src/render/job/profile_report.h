// Rows of `lanelight profile`: the time of each stage, relative to the limits of the
// machine.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernels/simd/target.h"
#include "src/base/stat/interval.h"
#include "src/render/job/job.h"
#include "src/render/run/run.h"

namespace lanelight {

/// A level of memory: the caches that the system knows of, and main memory.
struct MemoryLevel {
  std::string name;             // "L1", "L2", "L3", "memory"
  std::size_t bytes = 0;        // its size; of main memory: of the machine
  std::size_t probe = 0;        // bytes that were read to measure it
  double bytes_per_second = 0;  // of contiguous reads; best of several trials
};

struct Peaks {
  std::vector<MemoryLevel> levels;  // from the nearest to the farthest
  double flops = 0;                 // single precision operations per second
  double fma_ipc = 0;               // instructions per cycle at that; 0 if unknown
  double seconds = 0;               // that the measurement took

  /// The nearest level that is larger than `bytes`.
  const MemoryLevel& LevelOf(double bytes) const;
};

/// Changes when a member changes its meaning or goes away, not when one is added.
inline constexpr int kProfileSchema = 1;

/// The limit of a stage, as far as the numbers show it (docs/profile.md).
enum class Bound {
  kUnknown,  // the counters that could tell are not there
  kMemory,   // at 60 % or more of the measured read bandwidth of a level
  kCompute,  // at 60 % or more of the instructions per cycle of the multiply-add loop
  kNeither   // far from both: latency, branches
};
/// "-", "memory", "compute", "neither".
const char* Name(Bound bound);

enum class RowKind { kStage, kPart, kPilot, kOutside, kGroup };
/// Name of the row of kPilot.
inline constexpr const char* kPilotRowName = "training passes";
/// "stage", "task", "pilot", "outside", "group".
const char* Name(RowKind kind);

struct ProfileRow {
  RowKind kind = RowKind::kStage;
  StageProfile counts;
  bool intersect = false;  // traces rays, to their closest hit or to a light
  double fraction = 0;     // of ProfileReport::seconds
  double bandwidth = 0;    // bytes of columns per second, read and written
  double of_peak = 0;      // of ProfileReport::level
  Bound bound = Bound::kUnknown;
  std::vector<double> ns_per_sample;  // of the repeats; counts.seconds: by their median

  double NsPerItem() const;
  /// Returns a processor counter per item; 0 without counters.
  double PerItem(Counter counter) const;
  double InstructionsPerCycle() const;
};

struct ProfileReport {
  std::vector<ProfileRow> rows;        // by falling share
  std::vector<ProfileRow> groups;      // sums over rows, by falling share
  std::vector<BounceProfile> bounces;  // of the first repeat, up to the last with rays
  std::uint64_t samples = 0;           // of the first repeat
  double rays_per_sample = 0;
  std::vector<double> ns_per_sample;  // sums over the rows, of the repeats
  std::vector<std::string> busy;      // BusyReasons()
  double seconds = 0;  // processor time of all threads: the sum of the rows
  double intersect_seconds = 0, other_stage_seconds = 0;
  /// Seconds by which the stages' clocks exceed the processor time: threads waited for a
  /// processor. Sum over all repeats.
  double waiting_seconds = 0;
  Peaks peaks;
  MemoryLevel level;  // where the columns of a wavefront live

  /// Returns the time of other stages over that of intersect stages; 0 without these.
  double Ratio() const;
  /// Returns the same ratio with all that is not a stage included.
  double RatioWithAll() const;
};

/// Confidence of intervals, and repeats that one of a median needs.
inline constexpr double kProfileConfidence = 0.95;
inline constexpr int kProfileRepeats = 6;

/// Returns the profile of renders of one job: counts are those of the first, times the
/// medians of all. `repeats`: at least one.
ProfileReport MakeProfileReport(std::span<const RunResult> repeats, const Peaks& peaks);
/// Returns the median of a row's ns_per_sample with its interval.
Interval MedianOf(const std::vector<double>& ns_per_sample);

/// Returns the JSON of docs/profile.schema.json. `result`: of the first repeat.
nlohmann::json ToJson(const ProfileReport& report, const Job& job,
                      const RunResult& result);
/// Returns one line for each row of this JSON.
std::string ProfileCsv(const nlohmann::json& profile);

/// Measures for about half a second. Checks the result of every loop (CheckFailure), so
/// that none is optimised away. `counters`: read the processor's, if available.
Peaks MeasurePeaks(SimdTarget target, bool counters);

/// Share of a limit from which a stage counts as bound by it.
inline constexpr double kBoundFrom = 0.6;

/// Fills bandwidth, of_peak and bound of a row from its counts, after Williams, Waterman
/// and Patterson 2009 ("Roofline"). `level`: where the columns live. Columns alone can
/// show that memory is the limit, never that it is not, since scene data (BVH, triangles,
/// textures, tables) is not in them; processor counters can.
void PlaceOnRoofline(const Peaks& peaks, const MemoryLevel& level, ProfileRow& row);

/// Returns a trace for chrome://tracing and ui.perfetto.dev ("Trace Event Format", JSON
/// array): one complete event ("X") per stage call and part of a task, in microseconds
/// since the start of the run, about 120 bytes each; one named track per thread, with an
/// instant event at its end if events were dropped. Counter events ("C") of stages that
/// intersect or shade have queue lengths, filled lanes and rays per second. `process`:
/// name in the viewer.
std::string TraceText(const RunResult& result, int lanes, const std::string& process);

/// Returns the dropped events of all threads.
std::uint64_t DroppedEvents(const RunTrace& trace);

}  // namespace lanelight
