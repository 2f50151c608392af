// How fast scenes render: the same renders again and again, of all rows in turn, so that
// a machine that changes its clock slows all of them, until medians are known well.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/render/job/settings.h"
#include "src/render/run/run.h"

namespace lanelight {

/// Of all intervals.
inline constexpr double kBenchConfidence = 0.95;
/// Rows that are measured together need this many repeats for an interval of the median.
inline constexpr int kLeastRepeats = 6;

struct ThroughputOptions {
  std::vector<std::string> scenes;   // files, or names of BenchScenes()
  RenderSettings settings;           // without spp: BenchSpp()
  std::vector<int> threads;          // one row each
  std::vector<std::string> targets;  // likewise
  double within = 0.01;  // half the interval over the median, at which it ends
  double seconds = 10;   // at most, for each row
};

/// One scene, on one SIMD target, with one number of threads.
struct ThroughputRow {
  std::string scene, target, strategy;
  int threads = 0, width = 0, height = 0;
  std::uint64_t spp = 0;
  std::vector<double> seconds;      // of the repeats
  std::vector<double> cpu_seconds;  // likewise, of all threads together
  double waiting_seconds = 0;  // of all repeats: while other programs had the processors
  RunResult counts;            // of the last one: the same in all, but for times
  std::size_t bytes_per_path = 0;
  std::uint32_t wavefront = 0;  // paths in flight of a thread

  /// Seconds of a render: the median, and its interval.
  Interval Seconds() const;
  /// Samples per second by the wall clock, and per second of processor time.
  Interval Rate() const;
  Interval CpuRate() const;
  /// Fraction of the time of all threads in which they waited for a processor.
  double Waiting() const;
  /// Half the interval over the median.
  double Spread() const;
  std::uint64_t rays() const { return counts.rays_closest + counts.rays_shadow; }
};

/// What stages of one kind take of a sample, all threads together.
struct StageGroup {
  const char* name;
  double ns_per_sample = 0;
  std::uint64_t items = 0, lane_slots = 0;

  double Lanes() const { return lane_slots ? double(items) / double(lane_slots) : 0; }
};
/// "generate", "closest", "shadow", "surface", "shade", "lights", "lights seen" (by the
/// camera), "film", "other".
std::vector<StageGroup> StageGroups(const ThroughputRow& row);

struct BenchProgress {
  std::string scene;
  std::size_t done = 0, scenes = 0;
  int repeats = 0;
  double worst = 0;  // of Spread()
};

/// Rows by scene, then target, then threads. Every image is compared with the first one
/// of its scene before anything is timed: CheckFailure where they differ. `stop` ends it
/// early; what has been measured is returned.
std::vector<ThroughputRow> MeasureThroughput(
    const ThroughputOptions& options, const std::atomic<bool>& stop,
    const std::function<void(const BenchProgress&)>& on_progress);

}  // namespace lanelight
