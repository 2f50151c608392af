// Separable filters over a plane. What lies beyond its edge equals the edge.
#pragma once

#include <vector>

#include "src/measure/compare/linear_image.h"

namespace lanelight {

/// Weights at -radius to radius: an odd number of them.
using Kernel = std::vector<float>;

/// out(x) = sum over k of kernel[k] in(x + k - radius), along rows.
Plane ConvolveRows(const Plane& in, int width, int height, const Kernel& kernel);
/// The same along columns.
Plane ConvolveColumns(const Plane& in, int width, int height, const Kernel& kernel);

}  // namespace lanelight
