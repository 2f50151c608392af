// How many samples a pixel has that does not have as many as others (allocation.h).
#pragma once

#include <cstdint>

#include "src/wavefront/films.h"

namespace lanelight {

/// Samples per pixel of the pilot: whole turns of replicates and pairs.
inline constexpr std::uint64_t kAllocationPilot = 16;
/// Limits of a pixel's samples beyond the pilot, over their mean.
inline constexpr double kLeastShare = 0.5, kMostShare = 4;

/// Samples of a pixel where pixels have `mean` of them on average.
struct Share {
  double weight = 1;       // samples beyond the pilot, over their mean
  double offset = 0.5;     // in [0, 1): which fractions of a turn are rounded up
  std::uint32_t turn = 1;  // samples that stay together

  /// Never falls as `mean` grows; `mean` itself for weight 1, and where indices of
  /// samples begin again (kSamplesPerSeed).
  std::uint64_t Samples(std::uint64_t mean) const;
  /// The largest mean at which it has no more than `samples`.
  std::uint64_t Mean(std::uint64_t samples) const;
};

/// Pixels of blocks of so many squared, from the image's origin on, are rounded alike.
inline constexpr int kShareBlock = 16;

/// The share of a pixel: the mean itself without weights, or until they are known.
Share ShareOf(const Films& films, int x, int y);

}  // namespace lanelight
