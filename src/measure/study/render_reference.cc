// Renders a study's reference, with checkpoints, since it may be the longest render.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/measure/study/reference.h"
#include "src/render/films/accumulator.h"
#include "src/render/films/colors.h"
#include "src/render/job/checkpoint.h"
#include "src/render/job/report.h"

namespace lanelight {
namespace {

std::unique_ptr<Checkpoint> OpenCheckpoint(const Job& job,
                                           const ReferenceOptions& options) {
  CheckpointSettings settings;
  settings.path = options.state;
  settings.resume = Resume::kIfAny;
  settings.finished = false;
  const auto on_problem = [problem = options.on_problem](const std::string& text) {
    if (problem) problem(text);
  };
  try {
    return std::make_unique<Checkpoint>(job, settings, HeadJson(job, "", false),
                                        on_problem);
  } catch (const InputError& error) {
    throw InputError("{}\nremove '{}' to render the reference from the start",
                     error.what(), options.state);
  }
}

Reference FromFilm(const FilmAccumulator& film) {
  Reference reference;
  reference.width = film.width();
  reference.height = film.height();
  ForEachPixel(film, [&](int x, int y) {
    reference.mean.push_back(RoundToFloat(film.Mean(x, y)));
    reference.variance.push_back(RoundToFloat(film.Variance(x, y)));
  });
  return reference;
}

void Finish(Checkpoint& checkpoint, const ReferenceOptions& options) {
  for (const std::string& problem : checkpoint.Finish()) {
    if (options.on_problem) options.on_problem(problem);
  }
}

}  // namespace

Reference RenderReference(const Job& scene, const ReferenceOptions& options) {
  Strategy strategy;
  strategy.sampler = SampleSequence::kIndependent;
  const Job job = WithRender(scene, strategy, options.spp, options.seed);
  FilmAccumulator film = MakeFilm(job);
  RunOptions run = RunOptionsOf(job);
  run.on_progress = options.on_progress;
  run.stop = options.stop;
  std::unique_ptr<Checkpoint> checkpoint;
  if (!options.state.empty()) {
    checkpoint = OpenCheckpoint(job, options);
    run.tiles = checkpoint->tiles();
    run.checkpointer = checkpoint.get();
  }
  const RunResult result = Run(job.scene, job.plan, run, film);
  if (checkpoint) Finish(*checkpoint, options);
  Reference reference = FromFilm(film);
  reference.strategy = ToText(strategy);
  reference.spp = options.spp;
  reference.seconds = result.seconds;
  return reference;
}

}  // namespace lanelight
