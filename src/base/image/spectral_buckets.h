// The buckets of wavelengths of a film that keeps spectra (pbrt-v4's Film "spectral").
#pragma once

#include <string>

#include "src/base/core/spectral_constants.h"

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

}  // namespace lanelight
