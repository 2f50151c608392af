#include "bench/efficiency.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace lanelight {
namespace {

Estimate Interval(double value, std::vector<double> resampled) {
  std::sort(resampled.begin(), resampled.end());
  const auto at = [&](double q) {
    return resampled[static_cast<std::size_t>(q * double(resampled.size() - 1))];
  };
  return {value, at(0.025), at(0.975)};
}

double Mean(const std::vector<double>& v) {
  double sum = 0;
  for (double x : v) sum += x;
  return sum / double(v.size());
}

std::vector<double> ImageMeans(const Repetitions& r) {
  std::vector<double> means;
  for (const auto& image : r.images) {
    double sum = 0;
    for (const Rgb& c : image) sum += Luminance(c);
    means.push_back(sum / double(image.size()));
  }
  return means;
}

double SampleVariance(const std::vector<double>& v) {
  const double mean = Mean(v);
  double sum = 0;
  for (double x : v) sum += (x - mean) * (x - mean);
  return sum / double(v.size() - 1);
}

// Two-sided p-value of Student's t by numerical integration of its density.
double StudentP(double t, double dof) {
  const double log_norm = std::lgamma((dof + 1) / 2) - std::lgamma(dof / 2) -
                          0.5 * std::log(dof * 3.14159265358979324);
  const int steps = 4000;
  const double end = std::min(std::abs(t), 200.0);
  double inside = 0;
  for (int i = 0; i < steps; ++i) {
    const double x = (i + 0.5) * end / steps;
    inside += std::exp(log_norm - (dof + 1) / 2 * std::log1p(x * x / dof));
  }
  return std::max(0.0, 1 - 2 * inside * end / steps);
}

double WelchP(const std::vector<double>& a, const std::vector<double>& b) {
  const double va = SampleVariance(a) / double(a.size());
  const double vb = SampleVariance(b) / double(b.size());
  if (!(va + vb > 0)) return 1;
  const double dof = (va + vb) * (va + vb) /
                     (va * va / double(a.size() - 1) + vb * vb / double(b.size() - 1));
  return StudentP((Mean(a) - Mean(b)) / std::sqrt(va + vb), dof);
}

// Repetition r of every strategy has the same seed, so that strategies that use the same
// random numbers share their luck: both are resampled together.
std::vector<std::size_t> ResampledIndices(std::size_t n, std::mt19937& random) {
  std::vector<std::size_t> indices(n);
  for (std::size_t& i : indices) i = random() % n;
  return indices;
}
std::vector<double> At(const std::vector<double>& v, const std::vector<std::size_t>& at) {
  std::vector<double> out;
  for (std::size_t i : at) out.push_back(v[i]);
  return out;
}

}  // namespace

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

std::vector<double> PixelScales(const std::vector<Repetitions>& all) {
  std::vector<double> mean;
  double count = 0, total = 0;
  for (const Repetitions& r : all) {
    for (const auto& image : r.images) {
      mean.resize(image.size());
      for (std::size_t i = 0; i < image.size(); ++i) mean[i] += Luminance(image[i]);
      ++count;
    }
  }
  for (double& m : mean) total += m /= count;
  // Black pixels would make any noise infinite: 1 % of the mean image is the least.
  const double least = 0.01 * total / double(mean.size());
  for (double& m : mean) m = std::max(m, least) * std::max(m, least);
  return mean;
}

std::vector<double> RelativeErrors(const Repetitions& r,
                                   const std::vector<double>& scales, double trimmed) {
  const double n = double(r.images.size());
  std::vector<double> sum(scales.size());
  for (const auto& image : r.images) {
    for (std::size_t i = 0; i < image.size(); ++i) sum[i] += Luminance(image[i]);
  }
  std::vector<double> errors;
  for (const auto& image : r.images) {
    std::vector<double> pixels;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const double d = Luminance(image[i]) - sum[i] / n;
      pixels.push_back(d * d / scales[i]);
    }
    std::sort(pixels.begin(), pixels.end());
    pixels.resize(pixels.size() -
                  static_cast<std::size_t>(trimmed * double(pixels.size())));
    errors.push_back(Mean(pixels) * n / (n - 1));
  }
  return errors;
}

Comparison Compare(const Repetitions& r, const Repetitions& baseline,
                   const std::vector<double>& scales) {
  const auto all = RelativeErrors(r, scales, 0);
  const auto base_all = RelativeErrors(baseline, scales, 0);
  const auto most = RelativeErrors(r, scales, kTrimmed);
  const auto base_most = RelativeErrors(baseline, scales, kTrimmed);
  std::mt19937 random(1);
  std::vector<double> variance, trimmed, seconds, efficiency, trimmed_efficiency;
  for (int i = 0; i < 2000; ++i) {
    const auto at = ResampledIndices(all.size(), random);
    variance.push_back(Mean(At(all, at)) / Mean(At(base_all, at)));
    trimmed.push_back(Mean(At(most, at)) / Mean(At(base_most, at)));
    seconds.push_back(Median(At(r.seconds, at)) / Median(At(baseline.seconds, at)));
    efficiency.push_back(1 / (variance.back() * seconds.back()));
    trimmed_efficiency.push_back(1 / (trimmed.back() * seconds.back()));
  }
  Comparison c;
  const double v = Mean(all) / Mean(base_all), t = Mean(most) / Mean(base_most);
  const double s = Median(r.seconds) / Median(baseline.seconds);
  c.variance = Interval(v, variance);
  c.trimmed_variance = Interval(t, trimmed);
  c.seconds = Interval(s, seconds);
  c.efficiency = Interval(1 / (v * s), efficiency);
  c.trimmed_efficiency = Interval(1 / (t * s), trimmed_efficiency);
  c.same_mean_p = WelchP(ImageMeans(r), ImageMeans(baseline));
  return c;
}

}  // namespace lanelight
