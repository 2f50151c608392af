// Sums over the replicates of a pixel's samples (src/vocabulary/path/replicates.h).
#pragma once

#include "src/base/core/vec.h"
#include "src/vocabulary/path/replicates.h"

namespace lanelight {

struct ReplicateSums {
  double of[kReplicates][3] = {};

  double Total(int channel) const {
    double total = 0;
    for (const auto& sum : of) total += sum[channel];
    return total;
  }
  /// Estimated variance of Total() / samples in one channel. The variance of a
  /// replicate's sum is taken to be in proportion to its samples n_r, so that with the
  /// deviations D_r from n_r times the mean, E[sum D_r^2] is that of one sample times n -
  /// sum n_r^2 / n.
  double VarianceOfMean(int channel, std::uint64_t samples,
                        const SampleGroups& groups) const;
};

inline double ReplicateSums::VarianceOfMean(int channel, std::uint64_t samples,
                                            const SampleGroups& groups) const {
  const double n = static_cast<double>(samples), mean = Total(channel) / n;
  double squares = 0, freedom = n;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    const double own = static_cast<double>(groups.InReplicate(samples, r));
    const double deviation = of[r][channel] - own * mean;
    squares += deviation * deviation;
    freedom -= own * own / n;
  }
  return squares / (freedom * n);
}

}  // namespace lanelight
