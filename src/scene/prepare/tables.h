// Tables that some strategies need, estimated by training passes and read by kernels.
// They steer probabilities and numbers of split paths, and never enter the image.
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

/// Values of paths, for roulettes that split: a coarse cache over space and orientation,
/// and the brightness of pixels. Cells without records have a negative `survive`.
struct PathValues {
  CellGrid grid;
  /// Brightness is sum_c channel[c] c: all channels count alike in the mean of the image,
  /// as they do in a relative error.
  float channel[3] = {1.0f / 3, 1.0f / 3, 1.0f / 3};
  AlignedVector<float> inverse_pixel;  // PilotImage::Inverse
  /// adjoint: the mean estimate. efficiency: sqrt(E[estimate^2] / cost).
  AlignedVector<float> survive;
  /// efficiency: sqrt(variance of the estimate / cost).
  AlignedVector<float> split;
  float scale = 1;  // efficiency: sqrt(cost / relative variance) of a camera path
};

struct StrategyTables {
  PathValues path_values;  // adjoint, efficiency: set by the training passes
};

}  // namespace lanelight
