#include <algorithm>

#include "src/base/core/check.h"
#include "src/base/stat/distributions.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {

Interval ErrorInterval(double estimate, double k1, double k2) {
  LL_CHECK_GE(estimate, 0.0);
  if (estimate == 0) return {0, 0, 0};
  constexpr double kTail = (1 - kEstimateConfidence) / 2;
  // Beyond these bounds nothing is left to widen, and FQuantile has its range.
  k1 = std::clamp(k1, 1.0, 1e9);
  k2 = std::clamp(k2, 1.0, 1e9);
  // The median of F is near 1, so the ends are on either side of the estimate.
  return {estimate, estimate * std::min(1.0, stat::FQuantile(kTail, k1, k2)),
          estimate * std::max(1.0, stat::FQuantile(1 - kTail, k1, k2))};
}

}  // namespace lanelight
