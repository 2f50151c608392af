#include "src/wavefront/decision_pilot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/wavefront/path_records.h"
#include "src/wavefront/plan_features.h"
#include "src/wavefront/unsplit_variances.h"
#include "src/wavefront/wavefront.h"

namespace lanelight {
namespace {

constexpr double kMissing = 3;  // standard errors

// Pixels that must carry a candidate's error: its sum is known to a quarter then. In last
// rounds of advice for 10 s, five seeds each, adjoint had 1.0 to 7.1 where caustics carry
// its error (material-testball, media: 0.46 times as efficient in long renders, although
// each of these rounds had it ahead), and 32 to 75 where it pays (corridor, veach-ajar;
// 14 once).
constexpr double kLeastPixels = 16;

// A mean over pixels whose standard error is below this part of it needs no second
// estimate. Where all is that even, what stratified points gain also hangs on the numbers
// that decisions themselves use (a closed room), which copies know nothing of.
constexpr double kSure = 0.1;

bool IsSure(const std::vector<double>& variances) {
  double sum = 0, squares = 0;
  for (double v : variances) sum += v, squares += v * v;
  return squares - sum * sum / double(variances.size()) <= kSure * kSure * sum * sum;
}

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Both estimate the same; but what has seen less bright samples than the other tells
// nothing new, and where it is all noise it may be negative.
std::vector<double> Both(const std::vector<double>& own, std::vector<double> unsplit) {
  if (Sum(unsplit) < Sum(own)) return own;
  for (std::size_t i = 0; i < unsplit.size(); ++i) unsplit[i] = (own[i] + unsplit[i]) / 2;
  return unsplit;
}

}  // namespace

PilotGain DecisionEntry::Gain() const {
  PilotGain gain = GainOf(measure, usual);
  if (!paired) gain.log = std::min(gain.log, std::log(usual.Score() / measure.Score()));
  gain.log = std::min(gain.log, gain.least);
  return gain;
}

bool DecisionEntry::MissesLight() const {
  const double error = std::hypot(light.standard_error, usual_light.standard_error);
  return light.sum + kMissing * error < usual_light.sum;
}

// Without any error at all it is exact.
bool DecisionEntry::IsCarriedByFew() const {
  return Sum(measure.variances) > 0 && EffectivePixels(measure.variances) < kLeastPixels;
}

double DecisionEntry::Beyond(double must_gain, double standard_errors) const {
  const PilotGain all = GainOf(measure, usual);
  const double must = std::log(must_gain);
  if (all.least - standard_errors * all.standard_error <= must || MissesLight()) return 0;
  if (IsCarriedByFew()) return 0;
  // What has not seen the usual strategy's bright samples may owe its gain to one.
  if (!paired && !IsClearlyBetter(measure, usual, 1 / must_gain, standard_errors)) {
    return 0;
  }
  return Gain().log - must;
}

DecisionPilot::DecisionPilot(const CompiledScene& scene, const TrainingOptions& training,
                             std::uint32_t seed, const PilotSize& size)
    : scene_(scene),
      training_(training),
      seed_(seed),
      watcher_(training.stop),
      work_(MakeTrainingWork(scene_, size.samples, size.spp, size.turn)) {
  work_.spp -= work_.spp % kReplicates;
}

RunParameters DecisionPilot::Parameters(const PlanOptions& options,
                                        const StrategyTables& tables) const {
  RunParameters run = MakeRunParameters(scene_, MakePlan(scene_, options));
  run.seed = seed_;
  run.tables = &tables;
  return run;
}

TrainingOutcome DecisionPilot::Learn(const DecisionEntry& entry, std::uint64_t planned,
                                     StrategyTables& tables) {
  const Plan plan = MakePlan(scene_, entry.options);
  if (!NeedsTraining(plan)) return {};
  const RunParameters run = Parameters(entry.options, tables);
  TrainingOptions options = training_;
  options.planned_samples = planned;
  options.keep_roulette |= !entry.changes.empty();
  const TrainingOutcome out = Train({scene_, plan, run, options, tables});
  spent_.samples += out.samples;
  spent_.rays += out.rays;
  return out;
}

// It splits what otherwise plays the roulette that the records tell of.
bool DecisionPilot::RecordsUnsplit(const DecisionEntry& entry,
                                   const DecisionEntry& usual) const {
  const Strategy given = PlannedStrategy(scene_, usual.options);
  return given.roulette == Roulette::kThroughput && given.Floor() == 0 &&
         given.scale == 1 && given.First() == kThroughputFirst &&
         entry.changes == "roulette=adjoint";
}

TrainingSamples DecisionPilot::Render(const DecisionEntry& entry, bool records) {
  PlanOptions options = entry.options;
  options.auxiliary = Auxiliary::kNone;
  options.training = records ? FeatureSet{Feature::kRecordsUnsplit} : FeatureSet{};
  options.own_points = true;
  TrainingSamples samples = RunTrainingPass(
      scene_, options, Parameters(options, entry.tables), work_, &watcher_);
  spent_.samples += samples.colors.size();
  spent_.rays += samples.rays_closest + samples.rays_shadow;
  return samples;
}

PilotLight DecisionPilot::LightOf(const TrainingSamples& samples,
                                  const std::vector<double>& variances) const {
  PilotLight light;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    const std::uint32_t pixel = work_.pixels[i / work_.spp];
    const Vec3f& color = samples.colors[i];
    const float channels[] = {color.x, color.y, color.z};
    for (int c = 0; c < 3; ++c) {
      light.sum += channels[c] * std::sqrt(image_->ErrorWeight(pixel, c)) / 3 / work_.spp;
    }
  }
  light.standard_error = std::sqrt(Sum(variances) / work_.spp);
  return light;
}

bool DecisionPilot::Measure(DecisionEntry& entry, const DecisionEntry& usual) {
  if (Stopped()) return false;
  const bool records = RecordsUnsplit(entry, usual);
  const TrainingSamples samples = Render(entry, records);
  if (Stopped()) return false;
  // Weights are those of the image that the usual strategy shows.
  const RunParameters run = Parameters(entry.options, entry.tables);
  if (!image_) image_.emplace(run.width, run.height, work_.pixels, samples.colors);
  entry.measure = {entry.price * samples.Cost(),
                   RelativeVariances(samples, work_, *image_)};
  entry.light = LightOf(samples, entry.measure.variances);
  entry.usual = usual.measure;
  entry.usual_light = usual.light;
  entry.paired = records && !IsSure(usual.measure.variances);
  if (entry.paired) {
    entry.usual.variances =
        Both(usual.measure.variances,
             UnsplitVariances(samples, work_, *image_, entry.tables.path_values,
                              run.exposure, entry.measure.variances));
  }
  return true;
}

}  // namespace lanelight
