// Pilot passes, from which the roulettes that split learn what paths are worth.
//   adjoint     one pass that records: brightness of the pixels, values of the cells
//   efficiency  the same; then the fixed point of variance and cost by passes with
//               splitting, and a comparison of the strategy with no roulette and with
//               roulette on the throughput, all with the same pixels and random numbers
// They take about 4 percent of the planned samples and stop growing at 240 000 paths.
// Results do not depend on the number of threads: sums run in the order of the samples,
// costs are counted in rays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/train/trial_comparison.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/prepare/cell_grid.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kMaxTrainingSamples = 240'000;
// Fewer samples than this in a pass say too little of variances to choose by them.
constexpr std::uint64_t kMinPassSamples = 256;
// A splitting rule is chosen if the passes find it this much better: copies cost more
// than their rays, and the passes are short.
constexpr double kMargin = 0.87;

struct Candidate : TrialMeasure {
  Roulette roulette = Roulette::kThroughput;
  double scale = 1;

  // Returns the weight of variance against cost in the next pass of the fixed point.
  double Scale() const {
    const double variance = RobustMean(variances);
    return variance > 0 ? std::sqrt(cost / variance) : 1;
  }
};

std::string Change(Roulette roulette) {
  return std::string("roulette=") + Name(roulette);
}

class Pilot {
 public:
  explicit Pilot(const TrainingContext& context)
      : scene_(context.scene),
        plan_(context.plan),
        tables_(context.tables),
        seed_(context.seed),
        options_(context.options),
        values_(context.tables.path_values),
        watcher_(context.options.stop),
        efficiency_(plan_.features.Has(Feature::kEfficiencyRoulette)) {
    const std::uint64_t planned = options_.planned_samples;
    samples_ = efficiency_ ? std::min(planned * 3 / 400, kMaxTrainingSamples / 4)
                           : std::min(planned / 25, kMaxTrainingSamples);
    work_ = MakeTrainingWork(scene_, std::max<std::uint64_t>(samples_, 1));
  }

  TrainingOutcome Run() {
    if (efficiency_ && samples_ < kMinPassSamples && !options_.keep_roulette) {
      outcome_.changes = Change(Roulette::kThroughput);
      outcome_.note = "none, the image has too few samples: roulette=throughput";
      return outcome_;
    }
    // Until more is known, and if the user stops it.
    if (efficiency_ && !options_.keep_roulette) {
      outcome_.changes = Change(Roulette::kThroughput);
    }
    const PathSamples recorded = RecordPass();
    if (!efficiency_ || watcher_.IsStopped()) return outcome_;
    Compare(recorded);
    return outcome_;
  }

 private:
  static constexpr FeatureSet kMeasure = {}, kRecord = {Feature::kRecordsPaths};

  PathSamples Pass(const FeatureSet& records, Roulette roulette,
                   const TrainingWork& work) {
    PlanOptions options = WithChanges(scene_, plan_.options, Change(roulette));
    options.training = records;
    PathSamples samples = ReadRecords(RunTrainingPass(
        {scene_, options, &tables_, seed_, &watcher_, options_.ranks}, work));
    outcome_.samples += samples.colors.size();
    outcome_.rays += samples.rays();
    return samples;
  }

  // The colour of the image: brightness weighs the channels with it.
  void WeighChannels(const TrainingWork& few) {
    const PilotImage image =
        EstimatePilotImage(scene_, Pass(kMeasure, Roulette::kThroughput, few), few);
    for (int c = 0; c < 3; ++c) values_.channel[c] = image.Channel(c);
  }

  PathSamples RecordPass() {
    const Geometry& geometry = scene_.compiled->geometry;
    values_.grid = MakeCellGrid(geometry.bounds_min, geometry.bounds_max,
                                std::uint64_t{work_.samples()} * 2);
    WeighChannels(FewOf(work_));
    const PathSamples samples = Pass(kRecord, Roulette::kThroughput, work_);
    image_ = std::make_unique<PilotImage>(EstimatePilotImage(scene_, samples, work_));
    values_.inverse_pixel = image_->Inverse(!efficiency_);
    CellRecords records(values_.grid.cells());
    if (!image_->black()) Deposit(samples, records);
    SetCellValues(records, efficiency_, values_);
    outcome_.note = fmt::format("{} training samples", outcome_.samples);
    return samples;
  }

  // An event (a shadow ray and a scattered one, as far as the scene has them) costs what
  // remains after a ray from the camera per sample.
  void Deposit(const PathSamples& samples, CellRecords& records) const {
    const float exposure = ExposureOf(scene_);
    double events = 0;
    for (const PathRecord& r : samples.records) events += r.depth;
    const double cost_of_event =
        std::max(1.0, (samples.Cost() - 1) * double(samples.records.size()) /
                          std::max(events, 1.0));
    for (std::size_t i = 0; i < samples.records.size(); ++i) {
      const PathRecord& r = samples.records[i];
      const double maximum =
          PilotImage::kClamp * image_->Brightness(work_.pixels[i / work_.spp]);
      for (int k = 0; k < kRecordedVertices; ++k) {
        const PathRecord::Vertex& v = r.vertices[k];
        if (v.cell == kNoCell || !(v.at > 0)) continue;
        const double gathered =
            std::clamp<double>((r.end - v.got) * exposure, 0, maximum);
        const double cost = std::max(1.0, double(r.depth) - k) * cost_of_event;
        records.Add(v.cell, gathered / v.at, cost);
      }
    }
  }

  Candidate Measure(Roulette roulette, const PathSamples& samples) const {
    return {{samples.Cost(), RelativeVariances(samples, work_, *image_)},
            roulette,
            values_.scale};
  }

  // The fixed point: each pass weighs variance against cost as the one before found them.
  Candidate MeasureSplitting(const Candidate& throughput) {
    Candidate best, last = throughput;
    for (int pass = 0; pass < 2; ++pass) {
      values_.scale = float(last.Scale());
      last = Measure(Roulette::kEfficiency, Pass(kMeasure, Roulette::kEfficiency, work_));
      if (pass == 0 || last.Score() < best.Score()) best = last;
    }
    values_.scale = float(best.scale);
    return best;
  }

  // The better of no roulette and roulette on the throughput. Without roulette paths may
  // be very long: then a few of them have to do, and what they promise must be clear.
  Candidate BetterPlainRoulette(Candidate plain) {
    TrainingWork work = FewOf(work_);
    PathSamples samples = Pass(kRecord, Roulette::kNone, work);
    const bool cheap = samples.Cost() < 3 * plain.cost;
    if (cheap) {
      work = work_;
      samples = Pass(kRecord, Roulette::kNone, work);
    }
    const double ratio = RouletteVarianceRatio(samples, work, *image_);
    gain_of_none_ = ratio * plain.cost / samples.Cost();
    if (gain_of_none_ <= (cheap ? 1 : 2)) return plain;
    plain.roulette = Roulette::kNone;
    plain.cost = samples.Cost();
    for (double& v : plain.variances) v /= ratio;
    return plain;
  }

  void Compare(const PathSamples& recorded) {
    const Candidate throughput = Measure(Roulette::kThroughput, recorded);
    const Candidate splitting = MeasureSplitting(throughput);
    if (options_.keep_roulette || watcher_.IsStopped()) return;
    const Candidate plain = BetterPlainRoulette(throughput);
    if (watcher_.IsStopped()) return;
    const Roulette chosen = IsClearlyBetter(splitting, plain, kMargin)
                                ? Roulette::kEfficiency
                                : plain.roulette;
    outcome_.changes = Change(chosen);
    outcome_.note = fmt::format(
        "{} training samples: efficiency relative to throughput {:.2f} without roulette, "
        "{:.2f} with splitting; rendered with roulette={}",
        outcome_.samples, gain_of_none_, throughput.Score() / splitting.Score(),
        Name(chosen));
  }

  const PreparedScene& scene_;
  const Plan& plan_;
  const StrategyTables& tables_;
  const std::uint32_t seed_;
  const TrainingOptions& options_;
  PathValues& values_;
  const StopWatcher watcher_;
  const bool efficiency_;
  std::uint64_t samples_ = 0;  // that one pass may take
  TrainingWork work_;
  std::unique_ptr<PilotImage> image_;
  TrainingOutcome outcome_;
  double gain_of_none_ = 0;  // over roulette on the throughput
};

}  // namespace

TrainingOutcome TrainPathValues(const TrainingContext& context) {
  return Pilot(context).Run();
}

}  // namespace lanelight
