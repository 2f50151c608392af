// light-points=projected as plain formulas in double precision say it: the point of the
// primary-sample square for a point of a light, and the density over the square.
#pragma once

#include "tests/kernels/lights/flat_light.h"

namespace lanelight::test {

struct Square {
  double u0, u1;
};

double Cosine(Vec3d a, Vec3d b);

/// Returns how much farther outside of a rectangle the receiver's foot is along x than
/// along y; if it is, u0 goes along y. Near 0 rounding decides.
double FartherAlongX(const Flat& f);

/// u0 is the part of the solid angle cut off by the plane through the point (a, b) and
/// corner 1 (a rectangle: along a side), u1 the part that its height over corner 1 (the
/// other side) is of the height where the plane ends.
Square Invert(const Flat& f, double a, double b);

/// Weights at (u0, u1) = (0, 0), (1, 0), (0, 1), (1, 1), for a unit normal.
struct CornerCosines {
  double w[4];

  CornerCosines(const Flat& f, Vec3d normal);
  /// Over the square; its mean is 1.
  double Density(Square u) const;
};

}  // namespace lanelight::test
