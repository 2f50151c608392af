#include "src/base/stat/interval.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"

namespace lanelight::stat {
namespace {

// Wilson's, for a proportion of n trials and a quantile z.
Interval Wilson(double p, double n, double z) {
  const double z2 = z * z / n;
  const double centre = (p + z2 / 2) / (1 + z2);
  const double half = z * std::sqrt(p * (1 - p) / n + z2 / (4 * n)) / (1 + z2);
  return {p, std::clamp(centre - half, 0.0, p), std::clamp(centre + half, p, 1.0)};
}

}  // namespace

double Median(std::vector<double> values) {
  const std::size_t n = values.size();
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

double Mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

Interval MeanInterval(std::span<const double> values, double confidence) {
  LL_CHECK(confidence > 0 && confidence < 1);
  const double n = static_cast<double>(values.size());
  if (values.empty()) return WithoutBounds(std::numeric_limits<double>::quiet_NaN());
  double mean = 0, squares = 0;
  for (double v : values) mean += v / n;
  if (values.size() < 2) return WithoutBounds(mean);
  for (double v : values) squares += (v - mean) * (v - mean);
  const double half =
      StudentTwoSidedQuantile(1 - confidence, n - 1) * std::sqrt(squares / (n - 1) / n);
  return {mean, mean - half, mean + half};
}

Interval MedianInterval(std::span<const double> values, double confidence) {
  LL_CHECK(confidence > 0 && confidence < 1);
  const std::size_t n = values.size();
  if (n == 0) return WithoutBounds(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double median = (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
  if (n < 2) return WithoutBounds(median);
  // Values number k and n + 1 - k miss the median if fewer than k of the n lie on one of
  // its sides: each with the probability I_1/2(n - k + 1, k) of the binomial
  // (A&S 26.5.24).
  std::size_t k = 1;
  while (k < n / 2 &&
         2 * BetaI(static_cast<double>(n - k), static_cast<double>(k + 1), 0.5) <=
             1 - confidence) {
    ++k;
  }
  return {median, sorted[k - 1], sorted[n - k]};
}

Interval ProportionInterval(std::uint64_t successes, std::uint64_t trials,
                            double confidence) {
  LL_CHECK(confidence > 0 && confidence < 1 && successes <= trials);
  if (trials == 0) return WithoutBounds(std::numeric_limits<double>::quiet_NaN());
  const double n = static_cast<double>(trials);
  return Wilson(static_cast<double>(successes) / n, n,
                NormalQuantile((1 + confidence) / 2));
}

Interval ClusteredProportion(std::span<const Cluster> clusters, double confidence) {
  LL_CHECK(confidence > 0 && confidence < 1);
  double successes = 0, n = 0, squares = 0;
  for (const Cluster& c : clusters) {
    successes += static_cast<double>(c.successes);
    n += static_cast<double>(c.trials);
  }
  if (n == 0) return WithoutBounds(std::numeric_limits<double>::quiet_NaN());
  const double p = successes / n, m = static_cast<double>(clusters.size());
  if (m < 2) return WithoutBounds(p);
  for (const Cluster& c : clusters) {
    const double d = static_cast<double>(c.successes) - p * static_cast<double>(c.trials);
    squares += d * d;
  }
  // Variance of p relative to that of independent trials.
  const double effect = p * (1 - p) > 0 ? squares * m / (m - 1) / (n * p * (1 - p)) : 1;
  return Wilson(p, n / std::max(1.0, effect),
                StudentTwoSidedQuantile(1 - confidence, m - 1));
}

}  // namespace lanelight::stat
