// What a path is worth, for the roulettes that split: a coarse cache over space and
// orientation, and the brightness of the pixels, both estimated by training passes
// (src/render/train/train_path_values.cc). The values steer the number of copies and
// never enter the image.
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Cells of a box, times the six dominant directions of the normal.
struct CellGrid {
  float low[3] = {}, per_unit[3] = {};  // cell = (p - low) * per_unit
  std::int32_t size[3] = {1, 1, 1};

  std::uint32_t cells() const {
    return static_cast<std::uint32_t>(size[0] * size[1] * size[2]) * 6;
  }
};

/// Read by the kernels. A cell of which nothing is known has a negative `survive`.
struct PathValues {
  CellGrid grid;
  /// Brightness is sum_c channel[c] c: all channels count alike in the mean of the image,
  /// as they do in a relative error.
  float channel[3] = {1.0f / 3, 1.0f / 3, 1.0f / 3};
  AlignedVector<float> inverse_pixel;  // ImageGuess::Inverse
  /// adjoint: the mean estimate. efficiency: sqrt(E[estimate^2] / cost).
  AlignedVector<float> survive;
  /// efficiency: sqrt(variance of the estimate / cost).
  AlignedVector<float> split;
  float scale = 1;  // efficiency: sqrt(cost / relative variance) of a camera path
};

}  // namespace lanelight
