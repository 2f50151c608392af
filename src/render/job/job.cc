#include "src/render/job/job.h"

#include <algorithm>
#include <string>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/memory.h"
#include "src/render/job/transport.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/parse/parse.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

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

void SetTransport(LoadedScene& loaded, const RenderSettings& settings) {
  SceneDescription& description = loaded.description;
  std::optional<Transport>& transport = description.integrator.transport;
  if (description.film.buckets.count > 0) loaded.transport_why = "the film keeps spectra";
  if (transport) return;
  std::vector<Strategy> strategies = settings.compared;
  strategies.push_back(description.strategy);
  const TransportChoice choice = ChooseTransport(description, strategies);
  transport = choice.transport;
  loaded.transport_why = choice.why;
  if (!choice.refused) return;
  description.notes.push_back(
      {choice.refused_at, "rendered in red, green and blue, since " + choice.why});
}

// Returns why light subpaths are not supported, without advice about a flag that was not
// given.
std::string WhyNoLightPaths(const InputError& error) {
  const std::string text = error.what();
  const std::string verb = "does not support ";
  const std::size_t at = text.find(verb);
  if (at == std::string::npos) return text;
  const std::size_t begin = at + verb.size();
  const std::size_t end = std::min(text.find(": use", begin), text.size());
  return "light subpaths do not support " + text.substr(begin, end - begin);
}

// Plans the render. Removes light subpaths if only the scene's integrator asks for them
// and the scene does not support them.
Plan PlanOf(const RenderSettings& settings, SceneDescription& description,
            PreparedScene& scene) {
  const PlanOptions options = PlanOptionsOf(settings, description);
  if (!StartsAtLights(settings, description)) return MakePlan(scene, options);
  const SourceLocation& where = *description.integrator.from_lights;
  try {
    Plan plan = MakePlan(scene, options);
    if (plan.features.Has(Feature::kLightPaths)) {
      description.notes.push_back({where, "its strategy is light-paths=splats"});
    }
    return plan;
  } catch (const InputError& error) {
    Strategy strategy = scene.strategy;
    strategy.light_paths = LightPaths::kNone;
    scene = WithStrategy(std::move(scene), strategy);
    description.notes.push_back(
        {where, "no path starts at a light: " + WhyNoLightPaths(error)});
    return MakePlan(scene, options);
  }
}

Job Prepare(LoadedScene loaded, const RenderSettings& requested) {
  Job job;
  job.settings = requested;
  const RenderSettings& settings = job.settings;
  SceneDescription& description = loaded.description;
  Stopwatch watch;
  ApplySettings(settings, description);
  SetTransport(loaded, settings);
  job.window = RenderedPixels(description.film);
  CheckFilmFits(job.window, LayersOf(settings, description.film), description.strategy,
                PhysicalMemory());
  loaded.load_seconds += watch.Lap();

  CompileOptions compile = CompileOptionsOf(settings);
  compile.bvh_report = &loaded.trees;
  job.scene = PrepareScene(description, compile);
  job.settings.cached_bvh.reset();  // which may be all that keeps it
  job.plan = PlanOf(settings, description, job.scene);
  // Reports look for notes in one place.
  const std::vector<Note>& notes = job.scene.notes();
  description.notes.insert(description.notes.end(), notes.begin(), notes.end());
  ReleaseCopies(description);
  loaded.build_seconds = watch.Lap();
  job.loaded = std::make_shared<const LoadedScene>(std::move(loaded));
  return WithAmount(std::move(job), settings);
}

}  // namespace

Job PrepareJob(const std::string& scene_path, const RenderSettings& settings) {
  const ThreadLimit threads(settings.threads);
  Stopwatch watch;
  LoadedScene loaded;
  ParseOptions parse;
  parse.skip_unsupported = settings.skip_unsupported;
  parse.files = &loaded.files;
  ParallelInvoke([&] { loaded.description = ParseScene(scene_path, parse); },
                 [&] { loaded.scene_hash = HashSceneFiles(scene_path); });
  loaded.files.insert(scene_path);
  loaded.load_seconds = watch.Lap();
  return Prepare(std::move(loaded), settings);
}

Job PrepareJob(SceneDescription description, const RenderSettings& settings) {
  const ThreadLimit threads(settings.threads);
  LoadedScene loaded;
  loaded.description = std::move(description);
  return Prepare(std::move(loaded), settings);
}

Job WithAmount(Job job, const RenderSettings& settings) {
  const Sampler& own = job.loaded->description.sampler;
  job.seconds = settings.seconds.value_or(0);
  job.target = {settings.target_relmse.value_or(0), settings.target_rmse.value_or(0)};
  const bool scene_decides = !settings.seconds && !job.target.Any();
  job.spp = settings.spp.value_or(scene_decides ? std::uint64_t(own.spp) : 0);
  job.seed = settings.seed.value_or(own.seed);
  return job;
}

Job WithStrategy(Job job, const Strategy& strategy) {
  const ThreadLimit threads(job.settings.threads);
  job.scene = WithStrategy(std::move(job.scene), strategy);
  job.plan = MakePlan(job.scene, job.plan.options);
  return job;
}

Job WithRender(Job job, const Strategy& strategy, std::uint64_t spp, std::uint64_t seed) {
  job.spp = spp;
  job.seed = seed;
  return WithStrategy(std::move(job), strategy);
}

FilmAccumulator MakeFilm(const Job& job) {
  FilmAccumulator film(job.window.x0, job.window.y0, job.window.width(),
                       job.window.height(), GroupsOf(job.scene.strategy),
                       job.plan.options.auxiliary);
  if (job.plan.options.spectral_film) film.UseBuckets(job.scene.view->film.buckets);
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
