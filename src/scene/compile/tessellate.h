// Round shapes that have no record of their own, as triangles: cylinders, spheres and
// disks of which a part is there, ellipsoids and ellipses.
#pragma once

#include <memory>

#include "src/scene/compile/placement.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// True if the shape is to be rendered as triangles in coordinates that `transform` takes
/// it to: a cylinder, a part of a sphere or disk, or one that the transform bends.
bool IsTessellated(const Shape& shape, const Transform& transform);

/// The triangles of a sphere, disk or cylinder in object space. They are off the surface
/// (disks: off its rim) by at most `tolerance`, from 1e-6 to 1e-2, in units of the
/// radius, on the side of the axis or centre. Normals of vertices are those of the
/// surface, on the side of pbrt-v4's parametric normal: outward, +z for disks, and turned
/// round if the shape's transform mirrors. Surface coordinates are pbrt-v4's: u = phi /
/// phi_max, v from z_min to z_max (spheres: by polar angle), of disks from the rim
/// inward; they are exact at vertices, and within half of a triangle's width in between.
TriangleMesh Tessellate(const Shape& shape, double tolerance);

/// Tolerances for Tessellate, in radii: the finest, the coarsest, and that of objects,
/// whose instances are seen from anywhere.
inline constexpr double kFinestSphere = 4e-5, kFinestCylinder = 1e-5;
inline constexpr double kCoarsest = 1e-3, kOfObjects = 1e-4;
/// Bounds of the tolerance: this fraction of a pixel, as the camera sees the shape from
/// its nearest side.
inline constexpr double kTolerancePixels = 0.02;

/// Returns the tolerance for a sphere, disk or cylinder in the world.
double CameraTolerance(const PlacedShape& placed, const Camera& camera, const Film& film);

}  // namespace lanelight
