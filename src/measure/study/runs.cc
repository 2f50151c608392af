#include "src/measure/study/runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/source_location.h"
#include "src/measure/study/scene_runner.h"
#include "src/render/job/saving.h"
#include "src/scene/description/scene_names.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

std::vector<SceneRuns> NamedScenes(const StudyOptions& options) {
  std::vector<SceneRuns> scenes;
  const std::vector<std::string> names = SceneNames(options.scenes);
  for (std::size_t i = 0; i < names.size(); ++i) {
    SceneRuns scene;
    scene.path = options.scenes[i];
    scene.name = names[i];
    scene.folder = options.out + "/" + scene.name;
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

// Throws InputError for scenes of an earlier run that would be missing from the results.
void CheckOtherScenes(const StudyOptions& options, const std::vector<SceneRuns>& scenes) {
  for (const auto& entry : fs::directory_iterator(options.out)) {
    const std::string name = entry.path().filename().string();
    if (!fs::exists(entry.path() / "cells/scene.json")) continue;
    if (std::ranges::any_of(scenes,
                            [&](const SceneRuns& scene) { return scene.name == name; })) {
      continue;
    }
    throw InputError(
        "'{}' also has a study of the scene '{}', which the new tables would omit; name "
        "that scene too, or use another directory",
        options.out, name);
  }
}

// Checks paths before anything is written. SceneRunner checks further files that scenes
// read.
void CheckInputs(const StudyOptions& options, const std::vector<SceneRuns>& scenes) {
  OutputPaths outputs = {OutputFiles(options)};
  for (const SceneRuns& scene : scenes) outputs.folders.push_back(scene.folder);
  std::set<std::string> inputs(options.scenes.begin(), options.scenes.end());
  inputs.insert(options.references.begin(), options.references.end());
  CheckOutputPaths(outputs, inputs);
}

void CheckFolder(const StudyOptions& options) {
  std::error_code error;
  if (fs::exists(options.out, error) && !fs::is_directory(options.out, error)) {
    throw InputError("'" + options.out + "' is not a directory");
  }
  if (!options.resume && fs::is_directory(options.out, error) &&
      !fs::is_empty(options.out, error)) {
    throw InputError("'" + options.out +
                     "' is not empty; continue its study with --resume, or use another "
                     "directory");
  }
  fs::create_directories(options.out, error);
  if (error) throw InputError("cannot make '" + options.out + "': " + error.message());
}

// Presets of the figures from Figure 2 on; all are changes of paper-plain.
constexpr const char* kFigures[] = {"paper-uniform",    "paper-importance",
                                    "paper-stratified", "paper-antithetic",
                                    "paper-control",    "paper-roulette"};

std::vector<std::string> PaperStrategies() {
  std::vector<std::string> names = {"paper-plain"};
  names.insert(names.end(), std::begin(kFigures), std::end(kFigures));
  names.insert(names.end(), {kDefaultStrategyName, kSceneStrategyName});
  return names;
}

// Returns the default, each change of one choice, and the paper's presets.
std::vector<std::string> AllStrategies() {
  std::vector<std::string> names = {kDefaultStrategyName};
  for (const ChoiceInfo& c : AllChoices()) {
    names.push_back(std::string(c.axis) + "=" + c.name);
  }
  for (const PresetInfo& p : AllPresets()) names.push_back(p.name);
  names.push_back(kSceneStrategyName);
  return names;
}

}  // namespace

std::vector<std::string> OutputFiles(const StudyOptions& options) {
  return {options.out + "/study.json", options.out + "/study.csv",
          options.out + "/report.html"};
}

const char* Name(RunStatus status) {
  constexpr const char* kNames[] = {"ok", "same", "refused", "failed", "skipped"};
  return kNames[int(status)];
}

std::vector<SceneRuns> RunStudy(const StudyOptions& options, const StudyHooks& hooks) {
  CheckFolder(options);
  std::vector<SceneRuns> scenes = NamedScenes(options);
  CheckOtherScenes(options, scenes);
  CheckInputs(options, scenes);
  StudyClock clock(scenes.size());
  for (SceneRuns& scene : scenes) {
    try {
      SceneRunner(options, hooks, clock, scene).Run();
    } catch (const OtherStudy&) {
      throw;
    } catch (const WouldOverwrite&) {
      throw;
    } catch (const nlohmann::json::exception& error) {
      throw OtherStudy("'{}/cells/scene.json' is damaged ({}); use another directory",
                       scene.folder, JsonProblem(error));
    } catch (const std::exception& error) {
      scene.error = error.what();
      if (hooks.on_problem && scenes.size() > 1) hooks.on_problem(error.what());
    }
    clock.FinishScene();
  }
  return scenes;
}

int StudyOptions::Repetitions() const {
  if (repetitions) return *repetitions;
  return 2 + int(std::ceil(std::log2(2 / (1 - confidence))));
}

std::vector<NamedStrategy> StudyStrategies(const StudyOptions& options,
                                           const Strategy& own) {
  const std::vector<std::string> names = options.all_strategies ? AllStrategies()
                                         : options.strategies.empty()
                                             ? PaperStrategies()
                                             : options.strategies;
  std::vector<NamedStrategy> strategies;
  for (const std::string& name : names) {
    const auto same = [&](const NamedStrategy& other) { return other.name == name; };
    if (std::ranges::any_of(strategies, same)) continue;
    strategies.push_back(
        {name,
         StrategyNamed(name, {std::make_shared<const std::string>("--strategies"), 0, 0},
                       own)});
  }
  return strategies;
}

int PaperFigure(const std::string& name) {
  const auto found = std::ranges::find(kFigures, name);
  return found == std::end(kFigures) ? 0 : 2 + int(found - kFigures);
}

}  // namespace lanelight
