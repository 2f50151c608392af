#include "src/render/wave/copies.h"

#include <cstddef>

#include "src/base/core/check.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {

void FoldCopies(float* values, std::uint32_t rows, const SamplePlanes& planes) {
  const std::size_t samples = rows / kMostCopies;
  LL_CHECK_EQ(samples * kMostCopies, rows);
  const auto fold = [&](int plane, bool sums) {
    const float* from = values + static_cast<std::size_t>(plane) * rows;
    float* to = values + static_cast<std::size_t>(plane) * samples;
    for (std::size_t i = 0; i < samples; ++i) {
      float sum = from[i * kMostCopies];
      for (std::uint32_t c = 1; c < kMostCopies && sums; ++c) {
        sum += from[i * kMostCopies + c];
      }
      to[i] = sum;
    }
  };
  for (int g = 0; g < kNumPlaneGroups; ++g) {
    const auto group = static_cast<PlaneGroup>(g);
    if (!planes.Has(group)) continue;
    for (int p = 0; p < NumPlanes(group); ++p) {
      fold(planes.First(group) + p, SamplePlanes::Sums(group));
    }
  }
}

}  // namespace lanelight
