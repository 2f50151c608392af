#include "src/measure/study/runs.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/measure/study/scene_runner.h"
#include "src/render/job/saving.h"
#include "src/scene/description/scene_names.h"

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

// Tables and page would be without the scenes that are not named now.
void CheckOtherScenes(const StudyOptions& options, const std::vector<SceneRuns>& scenes) {
  for (const auto& entry : fs::directory_iterator(options.out)) {
    const std::string name = entry.path().filename().string();
    if (!fs::exists(entry.path() / "cells/scene.json")) continue;
    if (std::any_of(scenes.begin(), scenes.end(),
                    [&](const SceneRuns& scene) { return scene.name == name; })) {
      continue;
    }
    throw InputError(fmt::format(
        "'{}' has a study of the scene '{}' too, which would be missing from its tables: "
        "name that scene as well, or give another directory",
        options.out, name));
  }
}

// Before anything is written. What scenes read beside their own file is checked once it
// is known.
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
                     "' is not empty: continue the study that is there with --resume, or "
                     "give another directory");
  }
  fs::create_directories(options.out, error);
  if (error) throw InputError("cannot make '" + options.out + "': " + error.message());
}

}  // namespace

std::vector<std::string> OutputFiles(const StudyOptions& options) {
  return {options.out + "/study.json", options.out + "/study.csv",
          options.out + "/report.html"};
}

const char* Name(RunStatus status) {
  switch (status) {
    case RunStatus::kOk:
      return "ok";
    case RunStatus::kSame:
      return "same";
    case RunStatus::kRefused:
      return "refused";
    case RunStatus::kFailed:
      return "failed";
    case RunStatus::kSkipped:
      return "skipped";
  }
  return "";
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
      throw OtherStudy(
          fmt::format("'{}/cells/scene.json' is damaged ({}): give another directory",
                      scene.folder, JsonProblem(error)));
    } catch (const std::exception& error) {
      scene.error = error.what();
      if (hooks.on_problem && scenes.size() > 1) hooks.on_problem(error.what());
    }
    clock.FinishScene();
  }
  return scenes;
}

}  // namespace lanelight
