// From a scene file to a scene and a plan that can be run, with the time each step took.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "src/render/estimate/estimate.h"
#include "src/render/job/settings.h"
#include "src/render/plan/plan.h"
#include "src/render/run/run.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

struct LoadedScene;  // src/render/job/loaded_scene.h

/// A scene ready to render. Jobs are not changed: another strategy or amount makes
/// another job, and both can run at the same time. Copies share all large data.
struct Job {
  RenderSettings settings;  // that it was prepared with
  std::shared_ptr<const LoadedScene> loaded;
  PreparedScene scene;
  Plan plan;
  PixelRect window;
  std::uint64_t spp = 0;  // 0: until the time is over or the target is reached
  double seconds = 0;     // time budget; 0 = none
  ErrorTarget target;
  std::uint64_t seed = 0;

  /// Returns whether the number of samples is not known beforehand.
  bool OpenEnded() const { return spp == 0 || seconds > 0 || target.Any(); }
};

/// Parses, applies the overrides, checks that the film fits into memory, compiles, plans.
/// Throws InputError.
Job PrepareJob(const std::string& scene_path, const RenderSettings& settings);

/// Prepares a scene that is already parsed; its hash is 0.
Job PrepareJob(SceneDescription description, const RenderSettings& settings);

/// Returns the job with another strategy. Only the plan and LightChances are made again.
/// Throws InputError if the scene refuses the strategy.
Job WithStrategy(Job job, const Strategy& strategy);

/// Returns the job with another strategy, number of samples per pixel, and seed.
Job WithRender(Job job, const Strategy& strategy, std::uint64_t spp, std::uint64_t seed);

/// Returns the job with the amount and seed of the settings, or else of the scene.
Job WithAmount(Job job, const RenderSettings& settings);

/// Returns an empty film of the job's size.
FilmAccumulator MakeFilm(const Job& job);

/// Returns the options of a run of the job.
RunOptions RunOptionsOf(const Job& job);

/// The film and the result of a job.
struct JobRun {
  FilmAccumulator film;
  RunResult result;
};
/// Runs the job's plan. `stop` and `on_progress` as in RunOptions.
JobRun RunJob(const Job& job, std::function<void(const Progress&)> on_progress = {},
              const std::atomic<bool>* stop = nullptr);

/// Returns a 64-bit hash of the scene file and, recursively, of every file that a quoted
/// string in it names: included scenes, meshes, images. Missing files are omitted; the
/// parser reports them.
std::uint64_t HashSceneFiles(const std::string& scene_path);

}  // namespace lanelight
