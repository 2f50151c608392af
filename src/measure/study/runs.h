// Options of a study, and its renders.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/measure/study/cell_store.h"
#include "src/measure/study/reference.h"
#include "src/render/job/settings.h"
#include "src/scene/accel/build.h"

namespace lanelight {

/// Seconds of the largest render of the baseline.
inline constexpr double kDefaultStudySeconds = 1;

/// Longer renders may rank differently if the largest has fewer samples per pixel, unless
/// the relative error (the root of the relative MSE) is below kSmallError.
inline constexpr std::uint64_t kMinLargest = 64;
inline constexpr double kSmallError = 0.1;

struct StudyOptions {
  std::vector<std::string> scenes;
  RenderSettings settings;              // as for `render`; without spp and seconds
  std::vector<std::string> strategies;  // empty: the paper's presets and the default
  bool all_strategies = false;          // every choice of every axis
  std::vector<std::uint64_t> spp;       // empty: powers of two up to a budget
  std::optional<double> budget;         // seconds of the largest render of each strategy
  std::optional<int> repetitions;       // empty: see Repetitions()
  double confidence = 0.95;             // of all intervals
  std::vector<std::string> references;  // files; empty: rendered
  std::optional<double> target_relmse;  // empty: what the baseline reaches
  std::string out;                      // directory
  bool resume = false;
  bool paper = false;  // index.html too: the founding paper's figures on one page

  /// Returns `repetitions`, or 2 + ceil(log2(2 / a)) for a confidence of 1 - a: two more
  /// than a sign test needs. 8 for 95 %, 10 for 99 %.
  int Repetitions() const;
};

/// A strategy with its name on the command line: "default", "scene" (the scene's own), or
/// changes of the default.
struct NamedStrategy {
  std::string name;
  Strategy strategy;
};

/// Returns the strategies of a study on a scene whose own strategy is `base`, each name
/// once; several may be equal. Throws InputError for an invalid text.
std::vector<NamedStrategy> StudyStrategies(const StudyOptions& options,
                                           const Strategy& base);

/// Returns the number of the preset's figure in the founding paper (2 to 7), or 0.
int PaperFigure(const std::string& name);

enum class RunStatus {
  kOk,
  kSame,     // equal to another one on this scene, which is rendered
  kRefused,  // the scene does not support it
  kFailed,
  kSkipped  // interrupted
};
const char* Name(RunStatus status);  // "ok", "same", ...

/// One strategy of a scene.
struct StrategyRuns {
  NamedStrategy named;
  RunStatus status = RunStatus::kOk;
  std::string message;                      // reason of the status, or a note
  std::vector<std::uint64_t> counts;        // samples per pixel, ascending
  std::optional<std::size_t> same_as = {};  // index of the equal strategy of kSame
  /// Standard error of the logarithm of a budget's count, by the scatter of timed
  /// renders; 0 for given counts.
  double count_deviation = 0;

  std::string Text() const { return ToText(named.strategy); }
};

/// A render with one of the paper's diffuse models on all diffuse surfaces.
struct DiffuseModel {
  std::string name, meaning;
  std::vector<Rgb> image;
};

struct SceneRuns {
  std::string name, path;
  std::string error;  // reason why the scene failed; may be empty
  std::string hash;
  int full_width = 0, full_height = 0;
  PixelRect window;
  double load_seconds = 0, build_seconds = 0;
  BvhReport trees;  // BVHs; their time is part of build_seconds
  std::vector<std::string> notes;
  std::string differs;  // how images differ from the scene file; may be empty
  std::string folder;   // of state files and images
  Reference reference;
  std::vector<StrategyRuns> strategies;
  std::vector<DiffuseModel> diffuse;
  bool interrupted = false;
};

/// Progress of a study.
struct StudyProgress {
  std::string scene, what;  // what: e.g. "mis, 64 spp, repetition 3"
  double fraction = 0;      // of all its renders, by predicted cost
  double seconds = 0;       // wall clock of this run
  double seconds_left = 0;
};

struct StudyHooks {
  std::function<void(const StudyProgress&)> on_progress;  // may be empty
  std::function<void(const std::string&)> on_problem;     // failed cells; may be empty
  const std::atomic<bool>* stop = nullptr;
};

/// Returns the files of a study outside of the folders of scenes.
std::vector<std::string> OutputFiles(const StudyOptions& options);

/// Renders missing cells of DIR/cells, by scene, repetition, sample count and strategy,
/// so that changes of the machine's speed affect all strategies. Reports scenes and
/// strategies that fail and continues. Throws InputError if `out` cannot be written, or
/// has another study.
std::vector<SceneRuns> RunStudy(const StudyOptions& options, const StudyHooks& hooks);

}  // namespace lanelight
