// How finely round shapes are cut into triangles, by what the camera can see of them.
#pragma once

#include "src/scene/compile/placement.h"

namespace lanelight {

/// Tolerances for Tessellate, in radii: the finest, the coarsest, and that of objects,
/// whose instances are seen from anywhere.
inline constexpr double kFinestSphere = 4e-5, kFinestCylinder = 1e-5;
inline constexpr double kCoarsest = 1e-3, kOfObjects = 1e-4;
/// Bounds of the tolerance: this fraction of a pixel, as the camera sees the shape from
/// its nearest side.
inline constexpr double kSeenPixels = 0.02;

/// The tolerance for a sphere, disk or cylinder in the world.
double SeenTolerance(const PlacedShape& placed, const Camera& camera, const Film& film);

}  // namespace lanelight
