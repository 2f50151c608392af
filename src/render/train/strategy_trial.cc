#include "src/render/train/strategy_trial.h"

#include <algorithm>
#include <cmath>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/wave/wavefront.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kTrialSpp = 32;
constexpr double kMissingLightErrors = 3;  // standard errors

// Minimum number of pixels that carry a candidate's error; its sum is then known to 25 %.
// In trials for 10 s (five seeds), adjoint had 1.0 to 7.1 where caustics
// carry its error (material-testball, media: 0.46x the efficiency in long renders,
// although each of these trials preferred it). It had 32 to 75 where it is efficient
// (corridor, veach-ajar; 14 once).
constexpr double kMinEffectivePixels = 16;

// A mean over pixels whose standard error is below this part of it needs no second
// estimate. Where all is that even, what stratified points gain also depends on the
// numbers that decisions themselves use (a closed room), which copies know nothing of.
constexpr double kConvergedRelativeError = 0.1;

bool IsConverged(const std::vector<double>& variances) {
  double sum = 0, squares = 0;
  for (double v : variances) sum += v, squares += v * v;
  return squares - sum * sum / double(variances.size()) <=
         kConvergedRelativeError * kConvergedRelativeError * sum * sum;
}

// Averages two estimates of the same; but one that has seen fewer bright samples adds
// nothing, and may be negative where it is all noise.
TrialMeasure MeanOfMeasures(const TrialMeasure& own, TrialMeasure single) {
  if (single.Variance() < own.Variance()) return own;
  for (std::size_t i = 0; i < own.variances.size(); ++i) {
    single.variances[i] = (own.variances[i] + single.variances[i]) / 2;
  }
  return single;
}

// Returns whether the roulette differs, and nothing else.
bool DiffersByRoulette(Strategy changed, const Strategy& baseline) {
  if (changed == baseline) return false;
  changed.roulette = baseline.roulette;
  changed.floor = baseline.floor;
  changed.first = baseline.first;
  changed.scale = baseline.scale;
  return changed == baseline;
}

// Returns whether only the roulette differs, and paths survive it with a higher
// probability.
bool HasMilderRoulette(const Strategy& changed, const Strategy& baseline) {
  const bool longer =
      changed.roulette == baseline.roulette && changed.Floor() >= baseline.Floor() &&
      changed.scale >= baseline.scale && changed.First() >= baseline.First();
  return baseline.roulette == Roulette::kThroughput && longer &&
         DiffersByRoulette(changed, baseline);
}

// Returns whether learned selection of lights is all that differs.
bool DiffersByLearnedLights(Strategy changed, const Strategy& baseline) {
  if (changed.light_selection != LightSelection::kLearned || changed == baseline) {
    return false;
  }
  changed.light_selection = baseline.light_selection;
  return changed == baseline;
}

// Returns whether it splits paths whose records describe roulette on the throughput.
bool RecordsSinglePaths(const TriedStrategy& tried, const TriedStrategy& baseline) {
  const Strategy &changed = tried.strategy, &given = baseline.strategy;
  return given.roulette == Roulette::kThroughput && given.Floor() == 0 &&
         given.scale == 1 && given.First() == kThroughputFirst &&
         changed.roulette == Roulette::kAdjoint && DiffersByRoulette(changed, given);
}

// Returns whether few pixels carry the error; without any error it is exact.
bool IsFew(const std::vector<double>& variances) {
  const double pixels = EffectivePixels(variances);
  return pixels > 0 && pixels < kMinEffectivePixels;
}

}  // namespace

TrialGain TriedStrategy::EfficiencyGain() const {
  return IgnoresWorstPixels() ? GainWithoutWorst(measure, baseline)
                              : GainOf(measure, baseline);
}

TrialGain TriedStrategy::Gain() const {
  TrialGain gain = EfficiencyGain();
  if (!paired)
    gain.log = std::min(gain.log, std::log(baseline.Score() / measure.Score()));
  gain.log = std::min(gain.log, gain.minimum);
  return gain;
}

bool TriedStrategy::MissesLight() const {
  const double error = std::hypot(light.standard_error, baseline_light.standard_error);
  return light.sum + kMissingLightErrors * error < baseline_light.sum;
}

bool TriedStrategy::IsCarriedByFew() const { return IsFew(measure.variances); }

bool TriedStrategy::IgnoresWorstPixels() const {
  return milder_roulette && (IsCarriedByFew() || IsFew(baseline.variances));
}

double TriedStrategy::SignificantLogGain(double must_gain, double standard_errors) const {
  const TrialGain gain = EfficiencyGain();
  const double must = std::log(must_gain);
  if (gain.minimum - standard_errors * gain.standard_error <= must || MissesLight()) {
    return 0;
  }
  if (IsCarriedByFew() && !IgnoresWorstPixels() && !is_bounded) return 0;
  // A pass without the baseline strategy's bright samples may owe its gain to one of
  // them.
  if (!paired && !IsClearlyBetter(measure, baseline, 1 / must_gain, standard_errors)) {
    return 0;
  }
  return Gain().log - must;
}

TriedStrategy PrepareTrial(const PreparedScene& scene, const PlanOptions& options,
                           const std::string& changes, double price) {
  TriedStrategy tried;
  tried.changes = changes;
  tried.price = price;
  tried.options = WithChanges(scene, options, JoinedChanges(changes, "decide=none"));
  tried.strategy = PlannedStrategy(scene, tried.options);
  return tried;
}

StrategyTrial::StrategyTrial(const PreparedScene& scene, const TrainingOptions& training,
                             std::uint32_t seed, std::uint64_t planned)
    : scene_(scene),
      training_(training),
      seed_(seed),
      planned_(planned),
      watcher_(training.stop) {}

void StrategyTrial::Begin(std::uint64_t samples) {
  work_ = MakeTrainingWork(scene_, samples, kTrialSpp);
  work_.spp -= work_.spp % kReplicates;
  image_.reset();
}

TrainingOutcome StrategyTrial::TrainStrategy(const TriedStrategy& tried,
                                             std::uint64_t planned,
                                             StrategyTables& tables) {
  const Plan plan = MakePlan(scene_, tried.options);
  if (!NeedsTraining(plan)) return {};
  TrainingOptions options = training_;
  options.planned_samples = planned;
  const TrainingOutcome out = Train({scene_, plan, seed_, options, tables});
  spent_.samples += out.samples;
  spent_.rays += out.rays;
  return out;
}

TrainingSamples StrategyTrial::Render(const TriedStrategy& tried,
                                      const PlanOptions& options,
                                      const TrainingWork& work, const PilotImage* image) {
  TrainingPass pass = {scene_,    options,         &tried.tables, seed_,
                       &watcher_, training_.ranks, image};
  pass.options.has_own_sequences = true;
  TrainingSamples samples = RunTrainingPass(pass, work);
  spent_.samples += samples.colors.size();
  spent_.rays += samples.rays();
  return samples;
}

TrialLight StrategyTrial::LightOf(const TrainingSamples& samples,
                                  const TrialMeasure& measure) const {
  TrialLight light;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    const std::uint32_t pixel = work_.pixels[i / work_.spp];
    for (int c = 0; c < 3; ++c) {
      light.sum +=
          samples.colors[i][c] * std::sqrt(image_->ErrorWeight(pixel, c)) / 3 / work_.spp;
    }
  }
  light.standard_error = std::sqrt(measure.Variance() / work_.spp);
  return light;
}

bool StrategyTrial::Try(TriedStrategy& tried, const TriedStrategy& baseline) {
  if (!tried.has_learned) {
    TrainStrategy(tried, planned_, tried.tables);
    tried.has_learned = true;
  }
  if (!IsStopped()) Measure(tried, baseline);
  return !IsStopped();
}

void StrategyTrial::Measure(TriedStrategy& tried, const TriedStrategy& baseline) {
  PlanOptions options = tried.options;
  const bool records = RecordsSinglePaths(tried, baseline);
  if (records) options.training = FeatureSet{Feature::kRecordsSinglePaths};
  const TrainingSamples samples = Render(tried, options, work_);
  if (IsStopped()) return;
  // Weights are those of the image that the baseline strategy shows.
  if (!image_) image_ = EstimatePilotImage(scene_, samples, work_);
  tried.measure = {tried.price * samples.Cost(),
                   RelativeVariances(samples, work_, *image_)};
  tried.light = LightOf(samples, tried.measure);
  tried.baseline = baseline.measure;
  tried.baseline_light = baseline.light;
  tried.milder_roulette = HasMilderRoulette(tried.strategy, baseline.strategy);
  tried.is_bounded = DiffersByLearnedLights(tried.strategy, baseline.strategy);
  tried.paired = records && !IsConverged(baseline.measure.variances);
  if (!tried.paired) return;
  TrialMeasure single = baseline.measure;
  single.variances =
      SinglePathVariances(samples, work_, *image_, tried.tables.path_values,
                          ExposureOf(scene_), tried.measure.variances);
  tried.baseline = MeanOfMeasures(baseline.measure, std::move(single));
}

}  // namespace lanelight
