// Distributes the wavelengths of a path over the buckets of a film.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/image/spectral_buckets.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// Light of the colour (1, 1, 1) by wavelength: D65, of luminance 1, which is that of 1
/// at all wavelengths. What radiance in units of D65 is to be multiplied by for pbrt's
/// units.
Spectrum WhiteRadiance();

/// What a path adds to the sums of its pixel, whose mean over samples is then the mean of
/// radiance over those wavelengths of each bucket that paths carry.
class BucketShares {
 public:
  explicit BucketShares(const SpectralBuckets& buckets);

  /// Adds radiance in units of D65 in a bin of a triple that was drawn. Nothing of a
  /// bucket that no bin reaches: it stays 0.
  void Add(std::uint32_t bin, double radiance, double* sums) const {
    for (std::uint32_t i = begin_[bin]; i < begin_[bin + 1]; ++i) {
      sums[shares_[i].bucket] += shares_[i].of_radiance * radiance;
    }
  }

 private:
  struct Share {
    std::uint32_t bucket;
    double of_radiance;
  };
  std::vector<std::uint32_t> begin_;  // by bin, and the end of the last
  std::vector<Share> shares_;
};

}  // namespace lanelight
