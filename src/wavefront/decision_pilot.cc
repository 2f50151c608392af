#include "src/wavefront/decision_pilot.h"

#include "src/wavefront/path_records.h"
#include "src/wavefront/plan_features.h"
#include "src/wavefront/unsplit_variances.h"

namespace lanelight {
namespace {

// Samples of a pixel: a render's randomisations are as long or longer.
constexpr std::uint32_t kSpp = 32;

// A mean over pixels whose standard error is below this part of it needs no second
// estimate. Where all is that even, what stratified points gain also hangs on the numbers
// that decisions themselves use (a closed room), which copies know nothing of.
constexpr double kSure = 0.1;

bool IsSure(const std::vector<double>& variances) {
  double sum = 0, squares = 0;
  for (double v : variances) sum += v, squares += v * v;
  return squares - sum * sum / double(variances.size()) <= kSure * kSure * sum * sum;
}

// Both estimate the same.
std::vector<double> MeanOf(const std::vector<double>& a, std::vector<double> b) {
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = (a[i] + b[i]) / 2;
  return b;
}

}  // namespace

DecisionPilot::DecisionPilot(const TrainingContext& context, std::uint64_t samples)
    : scene_(context.scene),
      run_(context.run),
      training_(context.options),
      watcher_(context.options.stop),
      work_(MakeTrainingWork(scene_, samples, kSpp)) {
  work_.spp -= work_.spp % kReplicates;
}

TrainingOutcome DecisionPilot::Learn(const DecisionEntry& entry, std::uint64_t planned,
                                     StrategyTables& tables) {
  const Plan plan = MakePlan(scene_, entry.options);
  if (!NeedsTraining(plan)) return {};
  RunParameters run = run_;
  run.features = plan.features;
  run.tables = &tables;
  TrainingOptions options = training_;
  options.planned_samples = planned;
  options.keep_roulette |= !entry.name.empty();
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
         given.First() == kThroughputFirst && entry.name == "roulette=adjoint";
}

TrainingSamples DecisionPilot::Render(const DecisionEntry& entry, bool records) {
  PlanOptions options = entry.options;
  options.auxiliary = Auxiliary::kNone;
  options.training = records ? FeatureSet{Feature::kRecordsUnsplit} : FeatureSet{};
  options.own_points = true;
  RunParameters run = run_;
  run.tables = &entry.tables;
  TrainingSamples samples = RunTrainingPass(scene_, options, run, work_, &watcher_);
  spent_.samples += samples.colors.size();
  spent_.rays += samples.rays_closest + samples.rays_shadow;
  return samples;
}

bool DecisionPilot::Measure(DecisionEntry& entry, const DecisionEntry& usual) {
  if (Stopped()) return false;
  const bool records = RecordsUnsplit(entry, usual);
  const TrainingSamples samples = Render(entry, records);
  if (Stopped()) return false;
  // Weights are those of the image that the strategy as given shows.
  if (!image_) image_.emplace(run_.width, run_.height, work_.pixels, samples.colors);
  entry.measure = {samples.Cost(), RelativeVariances(samples, work_, *image_)};
  entry.usual = usual.measure;
  entry.paired = records && !IsSure(usual.measure.variances);
  if (entry.paired) {
    entry.usual.variances =
        MeanOf(usual.measure.variances,
               UnsplitVariances(samples, work_, *image_, entry.tables.path_values,
                                run_.exposure, entry.measure.variances));
  }
  return true;
}

}  // namespace lanelight
