// Long thin triangles, which the builder cuts, and points on them.
#pragma once

#include "src/scene/accel/builder.h"
#include "tests/support/brute_force.h"

namespace lanelight::brute {

/// n triangles of the given length and a hundredth of it wide in a cube of half side 1.
inline Geometry Sticks(Random& random, int n, float length) {
  Geometry g;
  for (int i = 0; i < n; ++i) {
    const Vec3f c = random.Point(1), along = length * random.Direction();
    const Vec3f across = 0.01f * length * random.Direction();
    g.triangles.push_back(MakeTriangle(c, c + along, c + along + across));
  }
  return g;
}

/// A point of a triangle, in double precision.
inline Vec3d PointOn(const TriangleRecord& triangle, Random& random) {
  double u = random(0, 1), v = random(0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Vec3d a = ToDouble(Corner(triangle, 0));
  return a + u * (ToDouble(Corner(triangle, 1)) - a) +
         v * (ToDouble(Corner(triangle, 2)) - a);
}

/// Returns whether a box holds a point up to its own rounding. `scale`: size of
/// coordinates.
inline bool Holds(const AccelBox& box, Vec3d p, double scale = 1) {
  const double rounding = 1e-15 * scale;
  for (int a = 0; a < 3; ++a) {
    if (p[a] < box.lo[a] - rounding || p[a] > box.hi[a] + rounding) return false;
  }
  return true;
}

}  // namespace lanelight::brute
