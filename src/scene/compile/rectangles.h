// Emitting rectangles: pairs of triangles of a mesh, found so that they become one light.
// One light instead of two leaves the choice between its halves out, which would use up a
// random number and split the strata of the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/base/core/vec.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

struct Rectangle {
  std::uint32_t first = 0, second = 0;  // indices into the mesh; first < second
  Vec3d corner;
  Vec3d x_side, y_side;  // from the corner; cross(x, y) is the triangles' normal
};

/// Finds the rectangles of one mesh, by `first`. Two right-angled triangles make one if
/// they share their longest side, lie in one plane, face the same way, and their corners
/// are those of an exact rectangle. The tolerance is float rounding of the coordinates (a
/// few ulp, at most 1e-4 of the shorter side) or 2e-5 of the shorter side. A triangle
/// belongs to at most one rectangle.
std::vector<Rectangle> FindRectangles(std::span<const TriangleRecord> mesh);

}  // namespace lanelight
