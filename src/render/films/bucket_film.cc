#include "src/render/films/bucket_film.h"

#include "src/base/core/aligned.h"
#include "src/base/core/check.h"

namespace lanelight {

BucketFilm::BucketFilm(const SpectralBuckets& buckets, std::size_t pixels)
    : buckets_(buckets), shares_(buckets) {
  LL_CHECK_GT(buckets.count, 0);
  ResizeInHugePages(sums_, pixels * static_cast<std::size_t>(buckets.count));
}

void BucketFilm::Add(std::size_t pixel, const float* const* radiance, const float* triple,
                     std::uint32_t count) {
  double* const sums = sums_.data() + pixel * static_cast<std::size_t>(buckets_.count);
  for (std::uint32_t i = 0; i < count; ++i) {
    auto bin = static_cast<std::uint32_t>(triple[i]);
    LL_DCHECK(bin < kTriples);
    for (int from_short = 2; from_short >= 0; --from_short, bin += kTriples) {
      shares_.Add(bin, double(radiance[from_short][i]), sums);
    }
  }
}

MutableStateColumn BucketFilm::Column() {
  return MakeStateColumn<double>(
      "buckets", "sums of radiance by bucket of wavelengths, D65 of luminance 1", sums_,
      {static_cast<std::size_t>(buckets_.count)});
}

}  // namespace lanelight
