// Measures rendering throughput. Rows are rendered in turn, so that a change of the clock
// rate affects all of them, until the intervals of their medians are narrow.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/base/core/machine_info.h"
#include "src/base/stat/interval.h"
#include "src/render/job/settings.h"
#include "src/render/run/run.h"

namespace lanelight {

struct SceneDescription;  // src/scene/description/description.h

/// A default scene of `lanelight bench`. Their texts are part of the program
/// (embed_bench.py), so that all users measure the same scenes.
struct BenchScene {
  const char* name;
  std::uint64_t spp;     // of a render; fixed, so that measurements can be compared
  const char* stresses;  // the parts of the renderer that take most of the time
  const char* text;
};

/// Returns the scenes in the order in which they are measured.
const std::vector<BenchScene>& BenchScenes();

/// A result in bench/results, part of the program (embed_bench.py).
struct StoredResult {
  const char *name, *text;
};
const std::vector<StoredResult>& StoredResults();

/// Returns the default samples per pixel of that scene; kFileSpp for scene files.
std::uint64_t BenchSpp(const std::string& scene);
inline constexpr std::uint64_t kFileSpp = 16;

/// Reads the scene of that name, or the scene file. Throws InputError.
SceneDescription ReadBenchScene(const std::string& scene);

/// Confidence of all intervals.
inline constexpr double kBenchConfidence = 0.95;
/// Repeats that an interval of the median needs.
inline constexpr int kMinRepeats = 6;

struct ThroughputOptions {
  std::vector<std::string> scenes;   // files, or names of BenchScenes()
  RenderSettings settings;           // BenchSpp() if spp is not set
  std::vector<int> threads;          // one row each
  std::vector<std::string> targets;  // one row each
  double within = 0.01;  // ends when RelativeHalfWidth() of all rows is at most this
  /// Seconds of all rows together, unless kMinRepeats take longer.
  double seconds = 60;
};

/// One scene, on one SIMD target, with one number of threads.
struct ThroughputRow {
  std::string scene, target, strategy;
  std::uint64_t scene_hash = 0;  // of the scene's text, or HashSceneFiles()
  int threads = 0, width = 0, height = 0;
  std::uint64_t spp = 0;
  std::vector<double> seconds;      // of the repeats
  std::vector<double> cpu_seconds;  // of the repeats, sums over all threads
  double waiting_seconds = 0;       // sum over repeats; other programs had the processors
  RunResult counts;                 // of the last repeat; all but times are equal in all
  std::size_t bytes_per_path = 0;
  std::uint32_t wavefront = 0;  // paths in flight of a thread

  /// Returns the median of the seconds of a render.
  Interval Seconds() const;
  /// Returns samples per second by the wall clock, and per second of processor time.
  Interval Rate() const;
  Interval CpuRate() const;
  /// Returns the fraction of all threads' time in which they waited for a processor.
  double WaitingFraction() const;
  /// Returns half the width of the interval divided by the median; infinite if unknown.
  double RelativeHalfWidth() const;
  std::uint64_t rays() const { return counts.rays_closest + counts.rays_shadow; }
};

/// Time that stages of one ProfileGroup take for a sample, summed over threads.
struct StageGroup {
  const char* name;
  double ns_per_sample = 0;
  std::uint64_t items = 0, lane_slots = 0;

  double Lanes() const { return lane_slots ? double(items) / double(lane_slots) : 0; }
};
/// Returns all groups, also those without stages, in the order of ProfileGroup.
std::vector<StageGroup> StageGroups(const ThroughputRow& row);

/// Returns the largest RelativeHalfWidth(); 0 without rows.
double MaxRelativeHalfWidth(const std::vector<ThroughputRow>& rows);

/// Returns the row with one thread, but the same scene and target; null without one.
const ThroughputRow* OneThreadRow(const std::vector<ThroughputRow>& rows,
                                  const ThroughputRow& row);

/// Returns the name of the scene file without folder and extension, or `scene` if another
/// scene of the rows has that name.
template <class Row>
std::string SceneLabel(const std::string& scene, const std::vector<Row>& rows) {
  const auto stem = [](const std::filesystem::path& path) { return path.stem(); };
  for (const Row& row : rows) {
    if (row.scene != scene && stem(row.scene) == stem(scene)) return scene;
  }
  return stem(scene);
}

struct BenchProgress {
  std::size_t scene = 0;            // its index
  double minimum = 0, maximum = 0;  // seconds left, if later scenes are like this one
};

/// Returns rows by scene, then target, then threads. Before timing, compares every image
/// with the first one of its scene; throws CheckFailure if they differ. Setting `stop`
/// ends it early and returns the rows measured so far. Calls `on_scene` for each scene
/// after its first renders, which are a warm-up; if it returns false, the measurement
/// ends.
std::vector<ThroughputRow> MeasureThroughput(
    const ThroughputOptions& options, const std::atomic<bool>& stop,
    const std::function<bool(const BenchProgress&)>& on_scene);

/// Returns BusyReasons() of the machine (src/base/core/machine_info.h), for the row that
/// waited longest.
std::vector<std::string> BusyReasons(const std::vector<ThroughputRow>& rows,
                                     const MachineInfo& machine);

/// Returns sentences on the uncertainty of these rows: whether the machine was busy, and
/// whether medians are less certain than `within`.
std::vector<std::string> ThroughputWarnings(const std::vector<ThroughputRow>& rows,
                                            double within);

/// Markdown without line breaks in rows, or text of at most `width` columns.
struct TableStyle {
  bool markdown = false;
  std::size_t width = 80;
};

/// Returns the machine and two tables: rates with intervals, and what they depend on.
std::string ThroughputText(const std::vector<ThroughputRow>& rows, double within,
                           const TableStyle& style);
/// Returns one line per row, each with the machine.
std::string ThroughputCsv(const std::vector<ThroughputRow>& rows);
}  // namespace lanelight
