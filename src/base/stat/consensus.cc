#include "src/base/stat/consensus.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"

namespace lanelight::stat {

Consensus ConsensusOf(std::span<const MeanEstimate> measurements, double least_variance) {
  LL_CHECK(!measurements.empty() && least_variance > 0);
  const auto weight = [&](const MeanEstimate& m) {
    return 1 / std::max(m.variance, least_variance);
  };
  double weights = 0, mean = 0, quartic = 0, chi_square = 0;
  for (const MeanEstimate& m : measurements) weights += weight(m);
  for (const MeanEstimate& m : measurements) {
    const double share = weight(m) / weights;
    mean += share * m.mean;
    quartic += share * share / std::max(m.dof, 1.0);
  }
  for (const MeanEstimate& m : measurements) {
    chi_square += weight(m) * (m.mean - mean) * (m.mean - mean);
  }
  Consensus out;
  const double freedom = double(measurements.size()) - 1;
  if (freedom > 0) out.birge = std::max(1.0, chi_square / freedom);
  // Each share of the variance is the square of its weight's share over its own.
  out.estimate = {mean, out.birge / weights, 1 / quartic};
  return out;
}

double DeparturePValue(const MeanEstimate& one, std::span<const MeanEstimate> others,
                       double least_variance) {
  if (others.empty()) return 1;
  const Consensus consensus = ConsensusOf(others, least_variance);
  MeanEstimate own = one;
  own.variance = std::max(own.variance, least_variance) * consensus.birge;
  return WelchPValue(own, consensus.estimate);
}

}  // namespace lanelight::stat
