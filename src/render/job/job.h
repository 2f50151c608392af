// From a scene file to a scene and a plan that can be run, with the time each step took.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "src/render/estimate/target.h"
#include "src/render/job/settings.h"
#include "src/render/plan/plan.h"
#include "src/render/run/run.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

struct LoadedScene;  // src/render/job/loaded_scene.h

/// A scene ready to render. Nothing takes one to change it; another strategy or amount
/// makes another job, and both can run at the same time. Copies share all that is large.
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

  /// How many samples there will be is not known beforehand.
  bool OpenEnded() const { return spp == 0 || seconds > 0 || target.Any(); }
};

/// Parses, applies the overrides, checks that the film fits into memory, compiles, plans.
/// Throws InputError.
Job PrepareJob(const std::string& scene_path, const RenderSettings& settings);

/// The same for a scene that is parsed already; its hash is 0.
Job PrepareJob(SceneDescription description, const RenderSettings& settings);

/// The job with another strategy. The scene is not compiled again, nor copied: what is
/// made anew is the plan, and LightChances. Throws InputError if the scene does not take
/// the strategy.
Job WithStrategy(Job job, const Strategy& strategy);

/// The same as a render of so many samples per pixel.
Job WithRender(Job job, const Strategy& strategy, std::uint64_t spp, std::uint64_t seed);

/// The job as much as the settings say, and with their seed, or else the scene's.
Job WithAmount(Job job, const RenderSettings& settings);

/// An empty film of the job's size.
FilmAccumulator MakeFilm(const Job& job);

/// How the job is to be run.
RunOptions RunOptionsOf(const Job& job);

/// A render of a job, and what it came to.
struct JobRun {
  FilmAccumulator film;
  RunResult result;
};
/// Runs the job's plan. `stop` and `on_progress` as in RunOptions.
JobRun RunJob(const Job& job, std::function<void(const Progress&)> on_progress = {},
              const std::atomic<bool>* stop = nullptr);

/// 64-bit hash of the scene file and, recursively, of every
/// file that a quoted string in it names: included scenes, meshes, images. Missing files
/// are left out; the parser reports them.
std::uint64_t HashSceneFiles(const std::string& scene_path);

}  // namespace lanelight
