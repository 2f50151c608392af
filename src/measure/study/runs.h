// The renders of a study: what ran, what did not and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/measure/study/cell_store.h"
#include "src/measure/study/options.h"
#include "src/measure/study/reference.h"
#include "src/scene/accel/build.h"

namespace lanelight {

enum class RunStatus {
  kOk,
  kSame,     // as another one on this scene: rendered once, under its name
  kRefused,  // the scene does not take it
  kFailed,
  kSkipped  // interrupted
};
const char* Name(RunStatus status);  // "ok", "same", ...

/// One strategy of a scene.
struct StrategyRuns {
  NamedStrategy named;
  RunStatus status = RunStatus::kOk;
  std::string message;                      // why not, or a note
  std::vector<std::uint64_t> counts;        // samples per pixel, ascending
  std::optional<std::size_t> same_as = {};  // of kSame: index of the one that is rendered
  /// Of a count that a budget was turned into: standard error of its logarithm, by the
  /// scatter of the pilots; 0 for counts that were given.
  double count_spread = 0;

  std::string Text() const { return ToText(named.strategy); }
};

/// One of the paper's diffuse models, put on all diffuse surfaces.
struct DiffuseModel {
  std::string name, meaning;
  std::vector<Rgb> image;
};

struct SceneRuns {
  std::string name, path;
  std::string error;  // not empty: the scene could not be studied
  std::string hash;
  int full_width = 0, full_height = 0;
  PixelRect window;
  double load_seconds = 0, build_seconds = 0;
  TreeReport trees;  // over shapes; their time is part of build_seconds
  std::vector<std::string> notes;
  std::string differs;  // not empty: the images are not what the scene file asks for
  std::string folder;   // state and images
  Reference reference;
  std::vector<StrategyRuns> strategies;
  std::vector<DiffuseModel> diffuse;
  bool interrupted = false;
};

/// What a study is doing.
struct StudyProgress {
  std::string scene, what;  // e.g. "mis, 64 spp, repetition 3"
  double fraction = 0;      // of all its renders, by predicted cost
  double seconds = 0;       // wall clock of this run
  double seconds_left = 0;
};

struct StudyHooks {
  std::function<void(const StudyProgress&)> on_progress;  // may be empty
  std::function<void(const std::string&)> on_problem;     // a cell failed; may be empty
  const std::atomic<bool>* stop = nullptr;
};

/// What a study writes beside the folders of its scenes.
std::vector<std::string> OutputFiles(const StudyOptions& options);

/// Renders what is missing in DIR/cells, one scene after the other; in each, repetition
/// after repetition, sample count after sample count, all strategies in turn, so that a
/// change of the machine's speed meets all alike. A scene or strategy that fails is
/// reported and does not end the study. Throws InputError if `out` cannot be written, or
/// holds another study.
std::vector<SceneRuns> RunStudy(const StudyOptions& options, const StudyHooks& hooks);

}  // namespace lanelight
