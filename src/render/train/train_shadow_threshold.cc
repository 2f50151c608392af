// A training pass, from which shadow-roulette=contribution learns how bright the pixels
// are and how noisy a sample is for its rays. It takes about 1 percent of the planned
// samples and stops growing at 60 000 paths.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kMaxShadowSamples = 60'000;
// Points that are stratified leave less variance than the independent ones of the pass,
// and the pass has that between the points of a pixel too; roulette adds noise that no
// stratification lowers.
constexpr double kStratified = 0.25;

TrainingSamples ShadowPass(const TrainingContext& context, const TrainingWork& work) {
  const StopWatcher watcher(context.options.stop);
  PlanOptions options = context.plan.options;
  if (context.plan.features.Has(Feature::kSplitting)) {
    options = WithChanges(context.scene, options, "roulette=throughput");
  }
  return RunTrainingPass({context.scene, options, &context.tables, context.seed, &watcher,
                          context.options.ranks},
                         work);
}

// The square of the mean standard deviation. By the mean variance a few pixels that see
// rare light would have all others save on rays that matter there; what most pixels have
// alone would leave nothing to save where light is rare everywhere.
double BaselineVariance(const std::vector<double>& variances) {
  double sum = 0;
  for (double v : variances) sum += std::sqrt(v);
  const double mean = sum / double(variances.size());
  return mean * mean;
}

}  // namespace

TrainingOutcome TrainShadowThreshold(const TrainingContext& context) {
  const std::uint64_t samples = std::clamp<std::uint64_t>(
      context.options.planned_samples / 100, 1, kMaxShadowSamples);
  const TrainingWork work = MakeTrainingWork(context.scene, samples);
  ShadowThreshold& pixel_threshold = context.tables.shadow_threshold;
  pixel_threshold.inverse.clear();  // the pass traces every ray
  const TrainingSamples pass = ShadowPass(context, work);
  const PilotImage image = EstimatePilotImage(context.scene, pass, work);
  const double variance = BaselineVariance(RelativeVariances(pass, work, image));
  const double fraction = kShadowRayCost / std::max(pass.Cost(), kShadowRayCost);
  const Film& film = context.scene.view->film;
  pixel_threshold.inverse = InverseShadowThreshold(
      image, std::uint32_t(film.width * film.height),
      std::sqrt(kStratified * variance * fraction), double{ExposureOf(context.scene)});
  TrainingOutcome outcome;
  outcome.samples = pass.colors.size();
  outcome.rays = pass.rays();
  outcome.note = fmt::format("{} training samples for shadow rays", outcome.samples);
  return outcome;
}

}  // namespace lanelight
