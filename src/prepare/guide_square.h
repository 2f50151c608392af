// The map between directions above a surface and the square of a guide's cell.
//
// A direction (x, y, z) in a frame about the normal is the point (x, y) of the disk,
// whose area is the projected solid angle. Rays of the disk become rays of the square
// [-1, 1]^2: the larger coordinate of the image is the distance r from the centre, the
// smaller one r times the ratio t of smaller to larger, so that
//   area of the square = (1 + t^2) area of the disk,  pdf_sa = pdf_square (1 + t^2) z.
// No root but r, no angle. kernels/guide/square-inl.h is the same in lanes.
#pragma once

#include <array>

#include "src/core/vec.h"
#include "src/prepare/guide.h"

namespace lanelight {

struct GuideSquarePoint {
  double u = 0, v = 0;        // in [0, 1]: ([-1, 1]^2 + 1) / 2
  double cosine = 0;          // z
  double to_solid_angle = 0;  // (1 + t^2) z; <= 0 at and below the horizon
};

/// Both unit vectors.
GuideSquarePoint ToGuideSquare(Vec3d normal, Vec3d direction);
/// The inverse, unit; u and v in [0, 1].
Vec3d FromGuideSquare(Vec3d normal, double u, double v);

/// Probability of each square, row by row, if directions are distributed like the cosine.
const std::array<double, kGuideSquares>& CosineMasses();

}  // namespace lanelight
