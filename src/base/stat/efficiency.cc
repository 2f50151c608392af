#include "src/base/stat/efficiency.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/stat/bootstrap.h"
#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"

namespace lanelight::stat {
namespace {

constexpr std::size_t kMinPairs = 3;
// Lower limit of seconds, so that a coarse clock cannot make an efficiency infinite.
constexpr double kMinCostSeconds = 1e-9;

Cost MeanCost(std::span<const Cost> costs) {
  Cost mean;
  for (const Cost& c : costs) {
    mean.error += c.error / static_cast<double>(costs.size());
    mean.seconds +=
        std::max(c.seconds, kMinCostSeconds) / static_cast<double>(costs.size());
  }
  mean.error = std::max(0.0, mean.error);
  return mean;
}

double LogRatio(std::span<const double> m) {
  return std::log(m[0] * m[1] / (m[2] * m[3]));
}

}  // namespace

Interval EfficiencyRatio(std::span<const Cost> baseline, std::span<const Cost> other,
                         double confidence) {
  LL_CHECK_EQ(baseline.size(), other.size());
  if (baseline.empty()) return WithoutBounds(std::numeric_limits<double>::quiet_NaN());
  const Cost a = MeanCost(baseline), b = MeanCost(other);
  if (a.error == 0 && b.error == 0) return WithoutBounds(a.seconds / b.seconds);
  if (a.error == 0) return WithoutBounds(0);
  if (b.error == 0) return WithoutBounds(std::numeric_limits<double>::infinity());
  const double value = a.error * a.seconds / (b.error * b.seconds);
  if (baseline.size() < kMinPairs) return WithoutBounds(value);

  Repetitions pairs(4);
  for (std::size_t i = 0; i < baseline.size(); ++i) {
    // Errors relative to their mean, so that no product leaves the range of double.
    pairs.Add(std::array{baseline[i].error / a.error,
                         std::max(baseline[i].seconds, kMinCostSeconds) / a.seconds,
                         other[i].error / b.error,
                         std::max(other[i].seconds, kMinCostSeconds) / b.seconds});
  }
  const double half = HalfWidth(pairs, LogRatio, confidence);
  const Interval ratio = {value, value * std::exp(-half), value * std::exp(half)};
  return ratio.HasBounds() ? ratio : WithoutBounds(value);
}

Interval Widened(const Interval& ratio, double deviation, double confidence) {
  if (!(deviation > 0) || !(ratio.value > 0) || !ratio.HasBounds()) return ratio;
  const double more = deviation * NormalQuantile((1 + confidence) / 2);
  const double below = std::hypot(std::log(ratio.value / ratio.low), more);
  const double above = std::hypot(std::log(ratio.high / ratio.value), more);
  return {ratio.value, ratio.value * std::exp(-below), ratio.value * std::exp(above)};
}

std::vector<RankRange> RankByEfficiency(const std::vector<std::vector<Cost>>& strategies,
                                        double confidence,
                                        std::span<const double> uncertainties) {
  const int n = static_cast<int>(strategies.size());
  std::vector<RankRange> ranks(strategies.size(), {1, n});
  if (n < 2) return ranks;
  const double level = SidakLevel(1 - confidence, n * (n - 1) / 2);
  for (std::size_t i = 0; i < strategies.size(); ++i) {
    for (std::size_t j = i + 1; j < strategies.size(); ++j) {
      const double extra_uncertainty =
          uncertainties.empty() ? 0 : std::hypot(uncertainties[i], uncertainties[j]);
      const Interval ratio =
          Widened(EfficiencyRatio(strategies[i], strategies[j], 1 - level),
                  extra_uncertainty, 1 - level);
      if (!ratio.HasBounds() || ratio.Contains(1)) continue;
      const bool other_is_better = ratio.low > 1;
      ranks[other_is_better ? i : j].best += 1;
      ranks[other_is_better ? j : i].worst -= 1;
    }
  }
  return ranks;
}

}  // namespace lanelight::stat
