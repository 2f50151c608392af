// Assigns the samples of a pixel to independent randomisations of the sample points. The
// assignment does not depend on the final number of samples, so a render can stop and
// resume anywhere.
//
// Each of kReplicates randomisations is an endless sequence of its own; samples take
// turns. After n samples there are kReplicates independent estimates from n / kReplicates
// points each: as good as points that were made for n where that is a power of two, and
// never an incomplete group. The scatter of the replicates shows the error at any moment.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lanelight {

/// Enough to estimate the error of a pixel; more would reduce stratification.
inline constexpr std::uint32_t kReplicates = 4, kLogReplicates = 2;

/// Maps the samples of a pixel to observations.
struct SampleGroups {
  // Successive samples that form one unit: 2 in antithetic pairs.
  std::uint32_t unit = 1;
  /// True: units are dealt to kReplicates observations in turn. False: each unit is one
  /// observation.
  bool replicates = false;
  /// Upper bound of the sum over all pixels of their squared error correlation with one
  /// pixel; 1 if pixels are independent. This many pixels are worth one independent
  /// pixel.
  double dependents = 1;

  bool operator==(const SampleGroups&) const = default;

  std::uint32_t Replicate(std::uint64_t sample) const {
    return static_cast<std::uint32_t>(sample / unit % kReplicates);
  }
  /// Returns the number of samples of a replicate among the first `samples`.
  std::uint64_t InReplicate(std::uint64_t samples, std::uint32_t replicate) const {
    const std::uint64_t cycle = std::uint64_t{unit} * kReplicates;
    const std::uint64_t before = std::uint64_t{unit} * replicate;
    const std::uint64_t rest = samples % cycle;
    return samples / cycle * unit +
           std::min<std::uint64_t>(unit, rest > before ? rest - before : 0);
  }
  /// Returns the number of independent observations among the first `samples`.
  std::uint64_t Observations(std::uint64_t samples) const {
    if (!replicates) return samples / unit;
    return std::min<std::uint64_t>(kReplicates, (samples + unit - 1) / unit);
  }
};

}  // namespace lanelight
