// Where the time of a render went, and how far from the limits of the machine: the rows
// of `lanelight profile`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/render/job/job.h"
#include "src/render/job/peaks.h"

namespace lanelight {

/// Changes when a member changes its meaning or goes away, not when one is added.
inline constexpr int kProfileSchema = 1;

/// The limit that a stage works at, as far as the numbers show it. docs/profile.md has
/// the rule.
enum class Bound {
  kUnknown,  // the counters that could tell are not there
  kMemory,   // at 60 % or more of the measured read bandwidth of a level
  kCompute,  // at 60 % or more of the instructions per cycle of the multiply-add loop
  kNeither   // far from both: latency, branches
};
/// "-", "memory", "compute", "neither".
const char* Name(Bound bound);

enum class RowKind { kStage, kPart, kPilot, kOutside };
/// Name of the row of kPilot.
inline constexpr const char* kPilotRowName = "training passes";
/// "stage", "task", "pilot", "outside".
const char* Name(RowKind kind);

struct ProfileRow {
  RowKind kind = RowKind::kStage;
  StageProfile counts;
  bool intersect = false;  // traces rays, to their closest hit or to a light
  double share = 0;        // of ProfileReport::seconds
  double bandwidth = 0;    // bytes of columns per second, read and written
  double of_peak = 0;      // of ProfileReport::level
  Bound bound = Bound::kUnknown;

  double NsPerItem() const;
  /// Of the processor's counters; 0 without them.
  double PerItem(Counter counter) const;
  double InstructionsPerCycle() const;
};

struct ProfileReport {
  std::vector<ProfileRow> rows;  // by falling share
  double seconds = 0;            // processor time of all threads: the sum of the rows
  double intersect_seconds = 0, other_stage_seconds = 0;
  /// By which the clocks of the stages exceed the processor time: the threads waited for
  /// a processor.
  double waiting_seconds = 0;
  Peaks peaks;
  MemoryLevel level;  // where the columns of a wavefront live

  /// Other stages over intersect; 0 without an intersect stage.
  double Ratio() const;
  /// The same with everything that is no stage.
  double RatioWithAll() const;
};

ProfileReport MakeProfileReport(const RunResult& result, const Peaks& peaks);

/// See docs/profile.md.
nlohmann::json ToJson(const ProfileReport& report, const Job& job,
                      const RunResult& result);

}  // namespace lanelight
