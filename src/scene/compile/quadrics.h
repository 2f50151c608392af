// Spheres, disks and planes to records.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Throw InputError if a radius is not positive. The transform keeps the shape (others
/// are tessellated: src/scene/compile/tessellate.h). Lights are left at -1.
SphereRecord CompileSphere(const PlacedShape& placed, const WorldFrame& frame,
                           std::uint32_t material);
DiskRecord CompileDisk(const PlacedShape& placed, const WorldFrame& frame,
                       std::uint32_t material);
/// With `keep_uv` the record's point is the object-space origin, from which uv count;
/// otherwise the point of the plane nearest to the scene's centre, for precision.
/// `eye`: the camera's position in the world (src/scene/compile/focus.h).
LargeSphereRecord CompileLargeSphere(const PlacedShape& placed, const WorldFrame& frame,
                                     Vec3d eye, std::uint32_t material);
PlaneRecord CompilePlane(const PlacedShape& placed, const WorldFrame& frame,
                         std::uint32_t material, bool keep_uv);

/// True if hits must be tested against the shape's alpha.
bool IsAlphaTested(const PlacedShape& placed);

}  // namespace lanelight
