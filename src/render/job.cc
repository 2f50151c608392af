#include "src/render/job.h"

#include <utility>

#include "src/core/parallel.h"
#include "src/core/stopwatch.h"
#include "src/parse/parse.h"
#include "src/prepare/chance_of_light.h"
#include "src/prepare/groups.h"
#include "src/prepare/prepare_scene.h"
#include "src/prepare/use_strategy.h"
#include "src/render/memory.h"
#include "src/scene/rendered_pixels.h"

namespace lanelight {
namespace {

// The compiled scene has its own copy; what reports still need is names and places.
void ReleaseCopies(SceneDescription& description) {
  for (Medium& medium : description.media) {
    medium.grid = {}, medium.emission_grid = {}, medium.temperature = {};
  }
  for (Shape& shape : description.shapes) shape.mesh.reset();
  for (ObjectDefinition& object : description.objects) {
    for (Shape& shape : object.shapes) shape.mesh.reset();
  }
}

}  // namespace

Job PrepareJob(const std::string& scene_path, const RenderSettings& settings) {
  const ThreadLimit threads(settings.threads);
  Stopwatch watch;
  ParseOptions parse;
  parse.skip_unsupported = settings.skip_unsupported;
  SceneDescription description;
  std::uint64_t scene_hash = 0;
  std::set<std::string> files;
  parse.files = &files;
  ParallelInvoke([&] { description = ParseScene(scene_path, parse); },
                 [&] { scene_hash = HashSceneFiles(scene_path); });
  const double seconds = watch.Lap();
  Job job = PrepareJob(std::move(description), settings);
  job.scene_hash = scene_hash;
  files.insert(scene_path);
  job.files = std::move(files);
  job.load_seconds += seconds;
  return job;
}

Job PrepareJob(SceneDescription description, const RenderSettings& asked) {
  const ThreadLimit threads(asked.threads);
  Job job;
  job.settings = asked;
  const RenderSettings& settings = job.settings;
  job.description = std::move(description);
  Stopwatch watch;
  ApplySettings(settings, job.description);
  job.window = RenderedPixels(job.description.film);
  CheckFilmFits(job.window, AuxiliaryOf(settings, job.description.film),
                job.description.strategy, PhysicalMemory());
  job.load_seconds = watch.Lap();

  CompileOptions compile = CompileOptionsOf(settings);
  compile.tree_report = &job.trees;
  job.scene = PrepareScene(job.description, compile);
  job.settings.trees.known.reset();  // which may be all that keeps it
  // Reports look for notes in one place.
  std::vector<Note>& notes = job.description.notes;
  notes.insert(notes.end(), job.scene.notes.begin(), job.scene.notes.end());
  ReleaseCopies(job.description);
  job.plan = MakePlan(job.scene, PlanOptionsOf(settings, job.description));
  job.build_seconds = watch.Lap();
  SetAmount(job, settings);
  return job;
}

void SetAmount(Job& job, const RenderSettings& settings) {
  const Sampler& own = job.description.sampler;
  job.seconds = settings.seconds.value_or(0);
  job.target = {settings.target_relmse.value_or(0), settings.target_rmse.value_or(0)};
  const bool scene_decides = !settings.seconds && !job.target.Any();
  job.spp =
      settings.spp.value_or(scene_decides ? static_cast<std::uint64_t>(own.spp) : 0);
  job.seed = settings.seed.value_or(own.seed);
}

void SetStrategy(Job& job, const Strategy& strategy) {
  const ThreadLimit threads(job.settings.threads);
  UseStrategy(strategy, job.scene);
  job.plan = MakePlan(job.scene, job.plan.options);
}

void SetRender(Job& job, const Strategy& strategy, std::uint64_t spp,
               std::uint64_t seed) {
  job.spp = spp;
  job.seed = seed;
  SetStrategy(job, strategy);
}

FilmAccumulator MakeFilm(const Job& job) {
  FilmAccumulator film(job.window.x0, job.window.y0, job.window.width(),
                       job.window.height(), GroupsOf(job.scene.strategy),
                       job.plan.options.auxiliary);
  film.set_chance_of_light(ChanceOfLight(job.scene));
  return film;
}

RunOptions RunOptionsOf(const Job& job) {
  RunOptions options;
  options.spp = job.spp;
  options.seconds = job.seconds;
  options.seed = job.seed;
  options.threads = job.settings.threads;
  if (job.target.Any()) {
    options.samples_needed = [target = job.target](const FilmAccumulator& film,
                                                   std::uint64_t done) {
      return SamplesNeeded(target, EstimateError(film), done);
    };
  }
  return options;
}

JobRun RunJob(const Job& job, std::function<void(const Progress&)> on_progress,
              const std::atomic<bool>* stop) {
  JobRun run = {MakeFilm(job), {}};
  RunOptions options = RunOptionsOf(job);
  options.on_progress = std::move(on_progress);
  options.stop = stop;
  run.result = Run(job.scene, job.plan, options, run.film);
  return run;
}

}  // namespace lanelight
