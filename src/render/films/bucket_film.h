// Sums of a film that keeps spectra, by pixel and bucket of wavelengths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/check.h"
#include "src/base/core/column.h"
#include "src/base/image/spectral_buckets.h"

namespace lanelight {

class BucketFilm {
 public:
  BucketFilm(const SpectralBuckets& buckets, std::size_t pixels)
      : buckets_(buckets), shares_(buckets) {
    LL_CHECK_GT(buckets.count, 0);
    ResizeInHugePages(sums_, pixels * std::size_t(buckets.count));
  }
  static std::size_t BytesPerPixel(const SpectralBuckets& buckets) {
    return std::size_t(buckets.count) * sizeof(double);
  }

  const SpectralBuckets& buckets() const { return buckets_; }
  /// Adds samples of a pixel: radiance at the long, the middle and the short wavelength
  /// of their paths, in units of D65, and the triple of wavelengths.
  void Add(std::size_t pixel, const float* const* radiance, const float* triple,
           std::uint32_t count) {
    double* const sums = sums_.data() + pixel * std::size_t(buckets_.count);
    for (std::uint32_t i = 0; i < count; ++i) {
      auto bin = std::uint32_t(triple[i]);
      LL_DCHECK(bin < kTriples);
      for (int from_short = 2; from_short >= 0; --from_short, bin += kTriples) {
        shares_.Add(bin, double(radiance[from_short][i]), sums);
      }
    }
  }
  double Sum(std::size_t pixel, int bucket) const {
    return sums_[pixel * std::size_t(buckets_.count) + std::size_t(bucket)];
  }
  MutableStateColumn Column() {
    return MakeStateColumn<double>(
        "buckets", "sums of radiance by bucket of wavelengths, D65 of luminance 1", sums_,
        {std::size_t(buckets_.count)});
  }

 private:
  SpectralBuckets buckets_;
  BucketFractions shares_;
  std::vector<double> sums_;  // of a pixel all buckets, then those of the next
};

}  // namespace lanelight
