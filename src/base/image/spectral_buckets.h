// The buckets of wavelengths of a film that keeps spectra (pbrt-v4's Film "spectral").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/spectral_constants.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {

/// `count` buckets of equal width from `first` to `last`, nm; none: 0.
struct SpectralBuckets {
  int count = 0;
  double first = kFirstNm, last = kLastNm;

  /// Where bucket i begins, and the one before it ends.
  double Edge(int i) const { return first + (last - first) * i / count; }
  friend bool operator==(const SpectralBuckets&, const SpectralBuckets&) = default;
};

/// The name of a bucket's channel in an EXR, by the wavelength in its middle, such as
/// "S0.374,688nm": S0 for light that is not polarised (Fichet, Pacanowski and Wilkie
/// 2021, "An OpenEXR Layout for Spectral Images", JCGT 10(3)), three digits as in
/// pbrt-v4.
std::string ChannelName(const SpectralBuckets& buckets, int i);

/// Spectrum of D65 of luminance 1: the factor that turns radiance in units of D65 into
/// pbrt's units.
Spectrum WhiteRadiance();

/// Contributions of a path to the bucket sums of its pixel. Their mean over samples is
/// the mean radiance over those wavelengths of a bucket that paths carry.
class BucketFractions {
 public:
  explicit BucketFractions(const SpectralBuckets& buckets);

  /// Adds radiance in units of D65 in a bin of the triple that was drawn. A bucket that
  /// no bin reaches stays 0.
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
