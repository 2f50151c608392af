// Estimates with confidence intervals, and the simplest ways to get them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lanelight {

/// An estimate with a confidence interval. Bounds that are not known are NaN.
struct Interval {
  double value = 0, low = 0, high = 0;

  bool HasBounds() const { return std::isfinite(low) && std::isfinite(high); }
  bool Contains(double x) const { return low <= x && x <= high; }
};

/// A value whose bounds are not known.
inline Interval WithoutBounds(double value) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return {value, kNan, kNan};
}

namespace stat {

/// Mean of independent values with Student's t interval; without bounds for fewer than
/// two values, NaN for none. `confidence` in (0, 1), here and below.
Interval MeanInterval(std::span<const double> values, double confidence);

/// NaN for none, as the next.
double Median(std::vector<double> values);
double Mean(std::span<const double> values);

/// Median with the interval between two order statistics whose coverage is at least
/// `confidence` for any continuous distribution; the whole range where the values are too
/// few for that (below 6 for 95 %). Without bounds for fewer than two values.
Interval MedianInterval(std::span<const double> values, double confidence);

/// Proportion with Wilson's (1927) score interval; NaN without trials.
Interval ProportionInterval(std::uint64_t successes, std::uint64_t trials,
                            double confidence);

/// Trials that may depend on each other.
struct Cluster {
  std::uint64_t successes = 0, trials = 0;
};

/// Proportion of the trials of independent clusters: Wilson's interval with Student's
/// quantile, for the number of independent trials that would scatter as the clusters do
/// (at most as many as there are; Korn and Graubard 1998). Without bounds for fewer than
/// two clusters, NaN without trials.
Interval ClusteredProportion(std::span<const Cluster> clusters, double confidence);

}  // namespace stat
}  // namespace lanelight
