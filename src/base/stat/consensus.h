// Decides whether one of several measurements of the same quantity departs from the
// others.
#pragma once

#include <span>

#include "src/base/stat/hypothesis.h"

namespace lanelight::stat {

/// Mean of independent measurements of one quantity, weighted by inverse variances. If
/// their chi-square shows that they vary more than their variances explain, the variance
/// of the mean is multiplied by Birge's (1932) ratio, chi-square over its degrees of
/// freedom. Variances below `least_variance` count as `least_variance` > 0.
struct Consensus {
  MeanEstimate estimate;
  double birge = 1;  // at least 1
};
Consensus ConsensusOf(std::span<const MeanEstimate> measurements, double least_variance);

/// p-value of the test that `one` measures what the `others` measure (Welch's test
/// against their consensus, both variances multiplied by their Birge ratio): large where
/// they do not agree among themselves. 1 without others.
double DeparturePValue(const MeanEstimate& one, std::span<const MeanEstimate> others,
                       double least_variance);

}  // namespace lanelight::stat
