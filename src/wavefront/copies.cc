#include "src/wavefront/copies.h"

#include <cstddef>

#include "src/core/check.h"
#include "src/image/accumulator.h"
#include "src/prepare/path_values.h"

namespace lanelight {

void FoldCopies(float* values, std::uint32_t rows, int planes, int difference) {
  const std::size_t samples = rows / kMostCopies;
  LL_CHECK_EQ(samples * kMostCopies, rows);
  for (int p = 0; p < planes; ++p) {
    const bool sums =
        p < kColorPlanes || (p >= difference && p < difference + kColorPlanes);
    const float* from = values + static_cast<std::size_t>(p) * rows;
    float* to = values + static_cast<std::size_t>(p) * samples;
    for (std::size_t i = 0; i < samples; ++i) {
      float sum = from[i * kMostCopies];
      for (std::uint32_t c = 1; c < kMostCopies && sums; ++c) {
        sum += from[i * kMostCopies + c];
      }
      to[i] = sum;
    }
  }
}

}  // namespace lanelight
