// Equal-area octahedral map between the unit square and the sphere, in the orientation of
// pbrt-v4: Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD". The
// centre of the square is +z, the corners are -z. Every region of the square covers a
// share of the sphere equal to its area: density over solid angle = density over the
// square / 4 pi.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "src/base/core/vec.h"

namespace lanelight {

/// Unit direction of a point of [0, 1]^2.
inline Vec3d OctahedralToDirection(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  const double abs_a = std::abs(a), abs_b = std::abs(b);
  // Signed distance to the diagonal that is the equator, and the ring it lies on.
  const double inside = 1 - (abs_a + abs_b);
  const double ring = 1 - std::abs(inside);
  // Angle within the quadrant, uniform along the ring.
  const double phi =
      (ring == 0 ? 1 : (abs_b - abs_a) / ring + 1) * (std::numbers::pi / 4);
  const double z = std::copysign(1 - ring * ring, inside);
  const double radius = ring * std::sqrt(std::max(0.0, 2 - ring * ring));
  return {radius * std::copysign(std::cos(phi), a),
          radius * std::copysign(std::sin(phi), b), z};
}

/// The point of [0, 1]^2 of a unit direction: inverse of OctahedralToDirection.
inline std::array<double, 2> DirectionToOctahedral(Vec3d d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  // sqrt(1 - z), without cancellation near the poles.
  const double ring = std::sqrt((x * x + y * y) / (1 + z));
  const double phi = x == 0 && y == 0 ? 0 : std::atan2(y, x) * (2 / std::numbers::pi);
  double v = phi * ring, u = ring - v;
  if (d.z < 0) {
    const double upper = u;
    u = 1 - v;
    v = 1 - upper;
  }
  return {(std::copysign(u, d.x) + 1) / 2, (std::copysign(v, d.y) + 1) / 2};
}

}  // namespace lanelight
