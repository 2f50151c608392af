#include "src/wavefront/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/check.h"
#include "src/wavefront/pilot_pass.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kMostPilotSamples = 240'000;
// Fewer samples than this in a pass say too little of variances to choose by them.
constexpr std::uint64_t kLeastToCompare = 1000;
// A splitting rule is chosen if the passes find it this much better: copies cost more
// than their rays, and the passes are short.
constexpr double kMargin = 0.87;

// Variances of a sample in each pixel, as relative errors weigh them.
std::vector<double> RelativeVariances(const PilotSamples& samples,
                                      const ImageGuess& image,
                                      const std::vector<std::uint32_t>& pixels) {
  std::vector<double> variances(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Vec3d sum, squares;
    for (std::uint32_t k = 0; k < kPilotSpp; ++k) {
      const Vec3f& v = samples.colors[i * kPilotSpp + k];
      const Vec3d d{v.x, v.y, v.z};
      sum += d;
      squares += {d.x * d.x, d.y * d.y, d.z * d.z};
    }
    for (int c = 0; c < 3; ++c) {
      const double scatter = std::max(0.0, squares[c] - sum[c] * sum[c] / kPilotSpp);
      variances[i] += scatter / (kPilotSpp - 1) * image.ErrorWeight(pixels[i], c) / 3;
    }
  }
  return variances;
}

// Mean without the worst thousandth: single bright samples would decide alone.
double RobustMean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t kept = values.size() - (values.size() + 999) / 1000;
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += values[i];
  return kept > 0 ? sum / static_cast<double>(kept) : 0;
}

// Variance with roulette on the throughput over that without, from the paths of a pass
// without (PilotRecord::Risk); the worst thousandth of the pixels is left out of both.
double RouletteVarianceRatio(const PilotSamples& samples, const ImageGuess& image,
                             const std::vector<std::uint32_t>& pixels) {
  std::vector<std::pair<double, double>> parts;  // variance without, added by roulette
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    double sum = 0, squares = 0, risk = 0;
    for (std::uint32_t k = 0; k < kPilotSpp; ++k) {
      const PilotRecord& r = samples.records[i * kPilotSpp + k];
      sum += r.end, squares += double{r.end} * r.end, risk += r.Risk();
    }
    double weight = 0;
    for (int c = 0; c < 3; ++c) weight += image.ErrorWeight(pixels[i], c);
    const double scatter = std::max(0.0, squares - sum * sum / kPilotSpp);
    parts.push_back({scatter / (kPilotSpp - 1) * weight, risk / kPilotSpp * weight});
  }
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.first + a.second < b.first + b.second;
  });
  const std::size_t kept = parts.size() - (parts.size() + 999) / 1000;
  double variance = 0, added = 0;
  for (std::size_t i = 0; i < kept; ++i) {
    variance += parts[i].first;
    added += parts[i].second;
  }
  return variance > 0 ? 1 + added / variance : 1;
}

struct Candidate {
  Roulette roulette = Roulette::kThroughput;
  double variance = 0, cost = 1, scale = 1;
  std::vector<double> variances;  // of the pixels

  double Score() const { return variance * cost; }  // 1 / efficiency
  // Of the fixed point: what the next pass weighs variance and cost with.
  double Scale() const { return variance > 0 ? std::sqrt(cost / variance) : 1; }
};

class Pilot {
 public:
  Pilot(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
        const PilotOptions& options, StrategyTables& tables)
      : scene_(scene),
        plan_(plan),
        run_(run),
        options_(options),
        values_(tables.path_values),
        efficiency_(plan.features.Has(Feature::kEfficiencyRoulette)) {
    run_.tables = &tables;
    const std::uint64_t samples =
        efficiency_ ? std::min(options.planned_samples * 3 / 400, kMostPilotSamples / 4)
                    : std::min(options.planned_samples / 10, kMostPilotSamples);
    pixels_ = PilotPixels(scene, std::max<std::uint64_t>(samples / kPilotSpp, 1));
  }

  PilotOutcome Run() {
    const PilotSamples recorded = RecordPass();
    if (outcome_.roulette == Roulette::kAdjoint || Stopped()) return outcome_;
    Compare(recorded);
    return outcome_;
  }

 private:
  bool Stopped() const { return options_.stop != nullptr && *options_.stop; }

  std::vector<std::uint32_t> Few() const {
    std::vector<std::uint32_t> few;
    for (std::size_t i = 0; i < pixels_.size(); i += 16) few.push_back(pixels_[i]);
    return few;
  }

  PilotSamples Pass(PilotPass kind, Roulette roulette,
                    const std::vector<std::uint32_t>& pixels) {
    PlanOptions options = plan_.options;
    options.aov = false;
    options.pilot = kind;
    options.roulette = roulette;
    PilotSamples samples = RunPilotPass(scene_, options, run_, pixels);
    outcome_.samples += samples.colors.size();
    outcome_.rays += samples.rays_closest + samples.rays_shadow;
    return samples;
  }

  // The colour of the image, from every 16th of the pixels: brightness weighs the
  // channels with it.
  void WeighChannels(const std::vector<std::uint32_t>& few) {
    const PilotSamples samples = Pass(PilotPass::kMeasure, Roulette::kThroughput, few);
    const ImageGuess image(run_.width, run_.height, few, samples.colors);
    for (int c = 0; c < 3; ++c) values_.channel[c] = image.Channel(c);
  }

  PilotSamples RecordPass() {
    const Geometry& geometry = scene_.geometry;
    values_.grid = MakeCellGrid(geometry.bounds_min, geometry.bounds_max,
                                std::uint64_t{pixels_.size()} * kPilotSpp * 2);
    WeighChannels(Few());
    const PilotSamples samples = Pass(PilotPass::kRecord, Roulette::kThroughput, pixels_);
    image_ =
        std::make_unique<ImageGuess>(run_.width, run_.height, pixels_, samples.colors);
    values_.inverse_pixel = image_->Inverse(!efficiency_);
    std::vector<CellSums> sums(values_.grid.cells());
    if (!image_->black()) Deposit(samples, sums);
    SetCellValues(sums, efficiency_, values_);
    if (!efficiency_ || options_.keep_roulette) {
      outcome_.roulette = efficiency_ ? Roulette::kEfficiency : Roulette::kAdjoint;
    }
    outcome_.note = fmt::format("{} pilot samples", outcome_.samples);
    return samples;
  }

  // An event (a shadow ray and a scattered one, as far as the scene has them) costs what
  // remains after a ray from the camera per sample.
  void Deposit(const PilotSamples& samples, std::vector<CellSums>& sums) const {
    double events = 0;
    for (const PilotRecord& r : samples.records) events += r.depth;
    const double cost_of_event =
        std::max(1.0, (samples.Cost() - 1) * double(samples.records.size()) /
                          std::max(events, 1.0));
    for (std::size_t i = 0; i < samples.records.size(); ++i) {
      const PilotRecord& r = samples.records[i];
      const double most = ImageGuess::kClamp * image_->Brightness(pixels_[i / kPilotSpp]);
      for (int k = 0; k < kPilotVertices; ++k) {
        const PilotRecord::Vertex& v = r.vertices[k];
        if (v.cell == kNoCell || !(v.at > 0)) continue;
        const double gathered =
            std::clamp<double>((r.end - v.got) * run_.exposure, 0, most);
        const double cost = std::max(1.0, double(r.depth) - k) * cost_of_event;
        sums[v.cell].Add(gathered / v.at, cost);
      }
    }
  }

  Candidate Measure(Roulette roulette, const PilotSamples& samples) const {
    Candidate c{roulette, 0, samples.Cost(), values_.scale, {}};
    c.variances = RelativeVariances(samples, *image_, pixels_);
    c.variance = RobustMean(c.variances);
    return c;
  }

  // The fixed point: each pass weighs variance against cost as the one before found them.
  Candidate MeasureSplitting(const Candidate& throughput) {
    Candidate best, last = throughput;
    for (int pass = 0; pass < 2; ++pass) {
      values_.scale = static_cast<float>(last.Scale());
      last = Measure(Roulette::kEfficiency,
                     Pass(PilotPass::kMeasure, Roulette::kEfficiency, pixels_));
      if (pass == 0 || last.Score() < best.Score()) best = last;
    }
    values_.scale = static_cast<float>(best.scale);
    return best;
  }

  // The better of no roulette and roulette on the throughput. Without roulette paths may
  // be very long: what they cost is tried on a few first.
  Candidate BetterPlain(Candidate throughput) {
    const double trial = Pass(PilotPass::kMeasure, Roulette::kNone, Few()).Cost();
    if (trial > 3 * throughput.cost) return throughput;
    const PilotSamples samples = Pass(PilotPass::kRecord, Roulette::kNone, pixels_);
    Candidate none = Measure(Roulette::kNone, samples);
    throughput.variance =
        none.variance * RouletteVarianceRatio(samples, *image_, pixels_);
    gain_of_none_ = throughput.Score() / none.Score();
    return gain_of_none_ > 1 ? none : throughput;
  }

  // Splitting must be better by the margin, and by two standard errors of the difference,
  // pixel by pixel.
  bool IsWorthIt(const Candidate& splitting, const Candidate& plain) const {
    const double n = static_cast<double>(pixels_.size());
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const double loss = splitting.cost * splitting.variances[i] -
                          kMargin * plain.cost * plain.variances[i];
      sum += loss, squares += loss * loss;
    }
    const double error = std::sqrt(std::max(0.0, squares - sum * sum / n));
    return sum + 2 * error < 0 && splitting.Score() < kMargin * plain.Score();
  }

  void Compare(const PilotSamples& recorded) {
    const Candidate throughput = Measure(Roulette::kThroughput, recorded);
    if (recorded.colors.size() < kLeastToCompare && !options_.keep_roulette) {
      outcome_.note += ": too few to compare, roulette on the throughput";
      return;
    }
    const Candidate splitting = MeasureSplitting(throughput);
    if (options_.keep_roulette) return;
    const Candidate plain = BetterPlain(throughput);
    outcome_.roulette =
        IsWorthIt(splitting, plain) ? Roulette::kEfficiency : plain.roulette;
    outcome_.note = fmt::format(
        "{} pilot samples: efficiency relative to throughput {} without roulette, {:.2f} "
        "with splitting; rendered with roulette={}",
        outcome_.samples,
        gain_of_none_ > 0 ? fmt::format("{:.2f}", gain_of_none_) : "(too long)",
        throughput.Score() / splitting.Score(), Name(outcome_.roulette));
  }

  const CompiledScene& scene_;
  const Plan& plan_;
  RunParameters run_;
  const PilotOptions& options_;
  PathValues& values_;
  const bool efficiency_;
  std::vector<std::uint32_t> pixels_;
  std::unique_ptr<ImageGuess> image_;
  PilotOutcome outcome_;
  double gain_of_none_ = 0;  // over roulette on the throughput; 0 = not tried
};

}  // namespace

PilotOutcome RunPilot(const CompiledScene& scene, const Plan& plan,
                      const RunParameters& run, const PilotOptions& options,
                      StrategyTables& tables) {
  LL_CHECK(plan.features.Has(Feature::kSplitting));
  return Pilot(scene, plan, run, options, tables).Run();
}

}  // namespace lanelight
