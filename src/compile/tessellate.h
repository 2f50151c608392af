// Round shapes that have no record of their own, as triangles: cylinders, spheres and
// disks of which a part is there, ellipsoids and ellipses.
#pragma once

#include <memory>

#include "src/scene/description.h"

namespace lanelight {

/// How far the triangles are from the surface at most, along its normal, in units of its
/// radius (before the transform). They lie on the side of the axis or centre.
inline constexpr double kSphereTolerance = 1e-4, kCylinderTolerance = 1e-5;

/// True if the shape is to be rendered as triangles in coordinates that `transform` takes
/// it to: a cylinder, a part of a sphere or disk, or one that the transform bends.
bool IsTessellated(const Shape& shape, const Transform& transform);

/// The triangles of a sphere, disk or cylinder in object space, within the tolerances
/// above (disks: their rim, within kCylinderTolerance). Normals of vertices are those of
/// the surface, on the side of pbrt-v4's parametric normal: outward, +z for disks, and
/// turned round if the shape's transform mirrors. Surface coordinates are pbrt-v4's: u =
/// phi / phi_max, v from z_min to z_max (spheres: by polar angle), of disks from the rim
/// inward; they are exact at vertices, and within 2e-3 in between.
TriangleMesh Tessellate(const Shape& shape);

}  // namespace lanelight
