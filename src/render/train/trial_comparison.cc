#include "src/render/train/trial_comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Scores of a pixel under both strategies.
struct PixelScores {
  double other, baseline;
  // Orders by the worse of both scores.
  bool operator<(const PixelScores& o) const {
    const double own = std::max(other, baseline), its = std::max(o.other, o.baseline);
    return own != its ? own < its
                      : std::min(other, baseline) < std::min(o.other, o.baseline);
  }
};

// Returns the scores of the pixels that count: the best `kept`.
std::vector<PixelScores> Pixels(const TrialMeasure& other, const TrialMeasure& baseline,
                                std::size_t kept) {
  LL_CHECK_EQ(other.variances.size(), baseline.variances.size());
  std::vector<PixelScores> pixels;
  for (std::size_t i = 0; i < other.variances.size(); ++i) {
    pixels.push_back(
        {other.cost * other.variances[i], baseline.cost * baseline.variances[i]});
  }
  std::sort(pixels.begin(), pixels.end());
  pixels.resize(kept);
  return pixels;
}

}  // namespace

std::size_t KeptOf(std::size_t n) { return n - std::min(n / 16, (n + 999) / 1000); }

double RobustMean(std::vector<double> values) {
  std::ranges::sort(values);
  values.resize(KeptOf(values.size()));
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double TrialMeasure::Variance() const {
  return std::accumulate(variances.begin(), variances.end(), 0.0);
}

double TrialMeasure::Score() const { return cost * RobustMean(variances); }

TrialGain GainOf(const TrialMeasure& other, const TrialMeasure& baseline) {
  LL_CHECK_EQ(other.variances.size(), baseline.variances.size());
  const double other_variance = other.Variance(), baseline_variance = baseline.Variance();
  const auto log_ratio = [&](double without_baseline, double without_other) {
    constexpr double kMaxLogGain = 100;
    const double u = baseline_variance - without_baseline,
                 o = other_variance - without_other;
    if (o <= 0 && u <= 0) return 0.0;
    if (u <= 0) return -kMaxLogGain;
    return o <= 0 ? kMaxLogGain : std::log(baseline.cost * u / (other.cost * o));
  };
  TrialGain gain;
  gain.log = gain.minimum = log_ratio(0, 0);
  if (other_variance <= 0 || baseline_variance <= 0) return gain;
  double squares = 0;
  for (std::size_t i = 0; i < other.variances.size(); ++i) {
    const double d =
        other.variances[i] / other_variance - baseline.variances[i] / baseline_variance;
    squares += d * d;
    gain.minimum =
        std::min(gain.minimum, log_ratio(baseline.variances[i], other.variances[i]));
  }
  gain.standard_error = std::sqrt(squares);
  return gain;
}

TrialGain GainWithoutWorst(const TrialMeasure& other, const TrialMeasure& baseline,
                           std::optional<std::size_t> omitted) {
  const std::size_t n = other.variances.size();
  const std::size_t kept = omitted ? n - std::min(n, *omitted) : KeptOf(n);
  TrialMeasure best = {other.cost, {}}, best_baseline = {baseline.cost, {}};
  for (const PixelScores& pixel : Pixels(other, baseline, kept)) {
    best.variances.push_back(pixel.other / other.cost);
    best_baseline.variances.push_back(pixel.baseline / baseline.cost);
  }
  return GainOf(best, best_baseline);
}

double EffectivePixels(const std::vector<double>& variances) {
  double sum = 0, squares = 0;
  for (double v : variances) sum += v, squares += v * v;
  return squares > 0 ? sum * sum / squares : 0;
}

bool IsClearlyBetter(const TrialMeasure& other, const TrialMeasure& baseline,
                     double margin, double standard_errors) {
  const std::vector<PixelScores> pixels =
      Pixels(other, baseline, KeptOf(other.variances.size()));
  double sum = 0, squares = 0;
  for (const PixelScores& pixel : pixels) {
    const double loss = pixel.other - margin * pixel.baseline;
    sum += loss, squares += loss * loss;
  }
  const double n = double(pixels.size());
  const double error = std::sqrt(std::max(0.0, squares - sum * sum / n));
  return sum + standard_errors * error < 0 && other.Score() < margin * baseline.Score();
}

}  // namespace lanelight
