#include "src/render/run/run_strategy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "src/base/core/stopwatch.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/rank_passes.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/profile.h"
#include "src/render/wave/shared_samples.h"
#include "src/render/wave/task_watcher.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/learned_lights.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

/// Samples that a time budget is expected to be enough for, by the speed of a few
/// thousand samples with roulette=throughput in this process; rounded down to a power of
/// two, so that runs on one machine mostly agree. At least 1. Takes about 20 ms.
std::uint64_t SamplesWithin(double seconds, TrainingPass pass) {
  constexpr int kPasses = 5;
  constexpr std::uint64_t kSamples = 2048;
  pass.options =
      WithChanges(pass.scene, pass.options, UntrainedChanges(pass.scene, pass.options));
  const TrainingWork work = MakeTrainingWork(pass.scene, kSamples, 16);
  double rate = INFINITY;
  // The first pass warms up: memory is touched, code and scene are read. The slowest of
  // the others counts: if other programs use the machine, one pass may run without them.
  for (int i = 0; i < kPasses; ++i) {
    const Stopwatch watch;
    RunTrainingPass(pass, work);
    if (i == 0) continue;
    rate = std::min(rate, double(work.samples()) / std::max(watch.Seconds(), 1e-6));
  }
  return std::bit_floor(std::uint64_t(std::clamp(rate * seconds, 1.0, 1e15)));
}

}  // namespace

std::uint32_t SeedOf(std::uint64_t seed, std::uint64_t first_sample) {
  const std::uint64_t seed_offset = first_sample / kSamplesPerSeed * 0x9e3779b97f4a7c15u;
  return std::uint32_t(seed ^ (seed >> 32) ^ (seed_offset >> 32));
}

RunStrategy::RunStrategy(const PreparedScene& scene, const Plan& plan,
                         const RunOptions& options, const RunClock& clock)
    : scene_(scene), plan_(plan), options_(options), clock_(clock), run_(Parameters()) {}

RunParameters RunStrategy::Parameters() const {
  RunParameters run = MakeRunParameters(scene_, plan_);
  run.seed = SeedOf(options_.seed, 0);
  run.tables = &tables_;
  return run;
}

void RunStrategy::SetFirstSample(std::uint64_t first) {
  run_.seed = SeedOf(options_.seed, first);
}

std::uint64_t RunStrategy::PlannedTraining() const {
  if (!NeedsTraining(plan_)) return 0;
  if (options_.planned_samples > 0) return options_.planned_samples;
  const std::uint64_t pixels = RenderedPixels(scene_.view->film).pixels();
  const bool decides = plan_.features.Has(Feature::kDecides);
  if (decides && options_.seconds > 0) {
    const StopWatcher watcher(options_.stop);
    return SamplesWithin(options_.seconds,
                         {scene_, plan_.options, &tables_, run_.seed, &watcher});
  }
  return decides ? DecidedBy(pixels)
                 : std::max(pixels * kTrainingSpp, kMinTrainingSamples);
}

void RunStrategy::Train(std::uint64_t planned, RankGroup& group) {
  if (options_.on_training) options_.on_training();
  RankPasses ranks(group, options_.stop);
  TrainingOptions options;
  options.planned_samples = planned;
  options.whole_image = options_.windows.empty();
  const bool together = group.ranks() > 1;
  options.stop = together ? ranks.stop() : options_.stop;
  options.ranks = together ? &ranks : nullptr;
  training_ = lanelight::Train({scene_, plan_, run_.seed, options, tables_});
  training_.seconds = clock_.Seconds();
  training_.cpu_seconds = clock_.CpuSeconds();
  // Interrupted training is repeated when the run is resumed.
  if (!StopWatcher(options.stop).IsStopped()) UseTraining();
}

void RunStrategy::Restore(TrainingOutcome training,
                          const std::vector<TrainedTable>& tables) {
  training_ = std::move(training);
  tables_.emission = MakeEmissionGuide(scene_.compiled->lights);
  tables_.lights = GroupLights(*scene_.compiled, scene_.chances->pmf);
  ImportTraining(tables, std::uint64_t{run_.width} * run_.height, tables_);
  UseTraining();
  CheckTrained(plan_, tables_);
}

// The image may be rendered with another roulette then.
void RunStrategy::UseTraining() {
  trained_ = true;
  const PlanOptions changed = WithChanges(scene_, plan_.options, training_.changes);
  if (PlannedStrategy(scene_, changed) == scene_.strategy) return;
  plan_ = MakePlan(scene_, changed);
  run_ = Parameters();
}

double RunStrategy::Dependents() const {
  return DependentsOf(PlannedStrategy(scene_, plan_.options), ReachOfFilter(scene_));
}

std::vector<TrainedTable> RunStrategy::Tables() const {
  return trained_ ? ExportTraining(tables_) : std::vector<TrainedTable>();
}

void RunStrategy::Describe(RunResult& result) const {
  result.training = training_;
  result.roulette = PlannedStrategy(scene_, plan_.options).roulette;
  result.stages = EmptyProfiles(plan_);
  result.bytes_in_flight = plan_.wavefront * plan_.bytes_per_path;
}

}  // namespace lanelight
