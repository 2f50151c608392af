// Errors of one strategy at one sample count, over its repetitions.
#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

std::vector<double> Collect(const std::vector<Measurement>& all,
                            double Measurement::* member) {
  std::vector<double> values;
  for (const Measurement& m : all) values.push_back(m.*member);
  return values;
}

// Clamps the lower bound of a squared error to 0. Its estimate may be negative, since the
// reference's own error is subtracted.
Interval NotNegative(Interval v) {
  if (v.value >= 0 && v.low < 0) v.low = 0;
  return v;
}

// Returns the roots of a mean square and its bounds; NaN for negative values, if all of
// the error is the reference's.
Interval Root(const Interval& square) {
  return {std::sqrt(square.value), std::sqrt(std::max(square.low, 0.0)),
          std::sqrt(square.high)};
}

// Returns the relative squared error of the mean image beyond its noise and that of the
// reference. With d the difference of a pixel, t^2 its variance and b the bias,
// Var(d^2 - t^2) = 2 t^4 + 4 b^2 t^2 for normal means; pixels are independent, and
// the channels of a pixel are assumed fully dependent.
Interval SquaredBias(const Moments& moments, const Reference& reference,
                     double confidence) {
  double sum = 0, variance = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Rgb d = moments.Mean(i) - reference.mean[i];
    const Rgb noise =
        moments.Variance(i) / double(moments.count()) + reference.Variance(i);
    const Rgb weight = reference.Weight(i);
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double square = d[c] * d[c] - noise[c];
      sum += weight[c] * square / 3;
      deviation +=
          weight[c] / 3 *
          std::sqrt(2 * noise[c] * noise[c] + 4 * std::max(square, 0.0) * noise[c]);
    }
    variance += deviation * deviation;
  }
  const double n = double(moments.size());
  const double half =
      stat::NormalQuantile(0.5 + confidence / 2) * std::sqrt(variance) / n;
  return {sum / n, sum / n - half, sum / n + half};
}

// Returns an estimate with at least the variance by the reference, since an image may
// have missed all rare samples.
stat::MeanEstimate WithReferenceVariance(const stat::MeanEstimate& own,
                                         const stat::MeanEstimate& known,
                                         double reference_per_image) {
  stat::MeanEstimate out = own;
  out.variance = std::max(out.variance, known.variance * reference_per_image);
  return out;
}

void TestMean(const Moments& moments, const Reference& reference, double confidence,
              LevelAnalysis& level) {
  const stat::MeanEstimate known = ReferenceMean(reference), own = ImageMean(moments);
  const double scale = known.mean != 0 ? std::abs(known.mean) : 1;
  const double bias = (own.mean - known.mean) / scale;
  level.bias = WithoutBounds(bias);
  if (moments.count() < 2) return;
  const double samples = double(level.spp) * double(moments.count());
  level.bias_p = stat::WelchPValue(
      WithReferenceVariance(own, known, double(reference.spp) / samples), known,
      kFloatRounding * scale);
  const double variance = own.variance + known.variance;
  if (variance == 0) {
    level.bias = {bias, bias, bias};
    return;
  }
  // Average() halves both: the degrees of freedom are those of their difference too.
  const double dof = stat::Average({own, known}).dof;
  const double half =
      stat::StudentTwoSidedQuantile(1 - confidence, dof) * std::sqrt(variance) / scale;
  level.bias = {bias, bias - half, bias + half};
}

SelfCheck CheckSelf(const std::vector<Measurement>& all, double confidence) {
  SelfCheck self;
  std::vector<double> estimates;
  for (const Measurement& m : all) {
    if (std::isfinite(m.self_relmse)) estimates.push_back(m.self_relmse);
    if (!m.HasSelf()) {
      self.refused += std::isfinite(m.self_relmse);
      continue;
    }
    ++self.total;
    self.inside += m.SelfIntervalCovers();
  }
  self.relmse = stat::MeanInterval(estimates, confidence);
  return self;
}

void CountRays(const std::vector<Measurement>& all, LevelAnalysis& level) {
  double samples = 0, closest = 0, shadow = 0;
  for (const Measurement& m : all) {
    samples += double(m.samples);
    closest += double(m.rays_closest);
    shadow += double(m.rays_shadow);
    level.invalid += m.invalid;
    level.mean += Rgb{m.mean_r, m.mean_g, m.mean_b} / double(all.size());
  }
  if (samples == 0) return;
  level.rays_per_sample = (closest + shadow) / samples;
  level.path_length = closest / samples;
}

}  // namespace

stat::MeanEstimate ReferenceMean(const Reference& reference) {
  std::vector<stat::MeanEstimate> pixels;
  for (std::size_t i = 0; i < reference.mean.size(); ++i) {
    pixels.push_back(reference.GreyEstimate(i));
  }
  return stat::Average(pixels);
}

stat::MeanEstimate ImageMean(const Moments& moments) {
  std::vector<stat::MeanEstimate> pixels;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    pixels.push_back(moments.GreyEstimate(i));
  }
  return stat::Average(pixels, moments.pixels_as_one);
}

LevelAnalysis AnalyseLevel(const Cells& cells, const Reference& reference,
                           std::uint64_t spp, double confidence) {
  const std::vector<Measurement>& all = cells.repetitions;
  const auto interval = [&](double Measurement::* member) {
    return NotNegative(stat::MeanInterval(Collect(all, member), confidence));
  };
  LevelAnalysis level;
  level.spp = spp;
  level.repetitions = all.size();
  level.rmse = Root(interval(&Measurement::mse));
  level.relmse = interval(&Measurement::relmse);
  level.relmse_trimmed = interval(&Measurement::relmse_trimmed);
  level.relmse_2 = interval(&Measurement::relmse_2);
  level.relmse_4 = interval(&Measurement::relmse_4);
  level.relmse_8 = interval(&Measurement::relmse_8);
  level.mape = interval(&Measurement::mape);
  level.worst_share = stat::Mean(Collect(all, &Measurement::worst_share));
  const double raw = stat::Mean(Collect(all, &Measurement::raw_relmse));
  level.reference_share = raw > 0 ? (raw - level.relmse.value) / raw : 0;
  level.cpu_seconds =
      stat::MedianInterval(Collect(all, &Measurement::cpu_seconds), confidence);
  level.wall_seconds =
      stat::MedianInterval(Collect(all, &Measurement::wall_seconds), confidence);
  CountRays(all, level);
  TestMean(cells.moments, reference, confidence, level);
  level.self = CheckSelf(all, confidence);
  if (all.size() < 2) {
    level.variance = level.bias2 = WithoutBounds(std::nan(""));
    return level;
  }
  level.bias2 = SquaredBias(cells.moments, reference, confidence);
  // The mean error is the sum of squared bias and variance; its interval is that of the
  // variance.
  level.variance = level.relmse;
  for (double* v : {&level.variance.value, &level.variance.low, &level.variance.high}) {
    *v -= level.bias2.value;
  }
  level.variance = NotNegative(level.variance);
  return level;
}

}  // namespace lanelight
