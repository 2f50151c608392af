// Grows the boxes of shapes against rounding.
#pragma once

#include <algorithm>
#include <cmath>

#include "src/scene/accel/builder.h"

namespace lanelight {

/// Growth of boxes that covers every rounding of the slab test and of the shape tests: 32
/// unit roundoffs (2^-24) per unit of coordinate, of the shape here and of the ray's
/// origin in the kernels. The triangle test needs 20 of them
/// (kernels/intersect/triangle-inl.h), the slab test 5 (kernels/intersect/bvh-inl.h).
inline constexpr float kShapeSlack = 0x1p-19f;

/// Largest |coordinate|.
inline float Reach(const AccelBox& box) {
  float reach = 0;
  for (int a = 0; a < 3; ++a) {
    reach = std::max({reach, std::abs(box.lo[a]), std::abs(box.hi[a])});
  }
  return reach;
}

/// The box of a shape, or of a part of it, grown for coordinates of the shape up to
/// `reach`: not those of the scene, so that a teapot in a stadium stays sharp.
inline AccelBox Grown(const AccelBox& box, float reach) {
  const float margin = kShapeSlack * reach;
  const Vec3f by{margin, margin, margin};
  return {box.lo - by, box.hi + by};
}

}  // namespace lanelight
