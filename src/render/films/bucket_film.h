// What a film that keeps spectra adds up, by pixel and bucket of wavelengths. Linear, so
// that pixels can be cut, put down, dealt out and added like all other sums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/image/spectral_buckets.h"

namespace lanelight {

class BucketFilm {
 public:
  BucketFilm(const SpectralBuckets& buckets, std::size_t pixels);
  static std::size_t BytesPerPixel(const SpectralBuckets& buckets) {
    return static_cast<std::size_t>(buckets.count) * sizeof(double);
  }

  const SpectralBuckets& buckets() const { return buckets_; }
  /// Samples of a pixel: radiance at the long, the middle and the short wavelength of
  /// their paths, in units of D65, and the triple that these are of.
  void Add(std::size_t pixel, const float* const* radiance, const float* triple,
           std::uint32_t count);
  double Sum(std::size_t pixel, int bucket) const {
    return sums_[pixel * static_cast<std::size_t>(buckets_.count) +
                 static_cast<std::size_t>(bucket)];
  }
  MutableStateColumn Column();

 private:
  SpectralBuckets buckets_;
  BucketShares shares_;
  std::vector<double> sums_;  // of a pixel all buckets, then those of the next
};

}  // namespace lanelight
