// Whether one of several measurements of the same quantity departs from the others.
#pragma once

#include <span>

#include "src/base/stat/hypothesis.h"

namespace lanelight::stat {

/// Mean of independent measurements of one quantity, weighted by the inverses of their
/// variances. Where they scatter more than their variances explain, as their chi-square
/// says, its variance is multiplied by Birge's (1932) ratio, chi-square over its degrees
/// of freedom: some variance is too small then, and nobody knows whose. Measurements of
/// variance 0 (below `least_variance`) count as if they had `least_variance` > 0.
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
