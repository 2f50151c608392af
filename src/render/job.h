// From a scene file to a scene and a plan that can be run, with the time each step took.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "src/render/settings.h"
#include "src/compiled/scene.h"
#include "src/scene/description.h"
#include "src/estimate/target.h"
#include "src/plan/plan.h"
#include "src/run/run.h"

namespace lanelight {

/// A scene ready to render.
struct Job {
  RenderSettings settings;       // that it was prepared with
  SceneDescription description;  // overrides applied; meshes released after compiling
  std::set<std::string> files;   // that the scene reads, its own among them
  CompiledScene scene;
  Plan plan;
  PixelRect window;
  std::uint64_t spp = 0;  // 0: until the time is over or the target is reached
  double seconds = 0;     // time budget; 0 = none
  ErrorTarget target;
  std::uint64_t seed = 0;
  std::uint64_t scene_hash = 0;  // see HashSceneFiles()
  double load_seconds = 0;       // reading and parsing
  double build_seconds = 0;      // compiling: acceleration structure, lights, textures
  TreeReport trees;              // over shapes: part of that

  /// How many samples there will be is not known beforehand.
  bool OpenEnded() const { return spp == 0 || seconds > 0 || target.Any(); }
};

/// Parses, applies the overrides, checks that the film fits into memory, compiles, plans.
/// Throws InputError.
Job PrepareJob(const std::string& scene_path, const RenderSettings& settings);

/// The same for a scene that is parsed already; its hash is 0.
Job PrepareJob(SceneDescription description, const RenderSettings& settings);

/// Switches the job to another strategy without compiling the scene again. Throws
/// InputError if the scene does not take it; then the job is to be given another.
void SetStrategy(Job& job, const Strategy& strategy);

/// Makes it a render of so many samples per pixel, likewise.
void SetRender(Job& job, const Strategy& strategy, std::uint64_t spp, std::uint64_t seed);

/// How much of it is rendered, and with what seed: as the settings say, else the scene.
void SetAmount(Job& job, const RenderSettings& settings);

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
