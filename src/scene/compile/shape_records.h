// Meshes, curves, spheres, disks and planes to records.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/transform.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// Destination of the triangles of a mesh. `normals` and `uvs` may be null (not stored).
/// `areas` may be null; otherwise it receives the areas before rounding.
struct MeshOutput {
  TriangleRecord* triangles = nullptr;
  float* normals = nullptr;
  float* uvs = nullptr;
  double* areas = nullptr;
};

/// Value of TriangleRecord::material that marks a degenerate triangle until it is
/// removed.
inline constexpr std::uint32_t kDegenerate = 0xffffffffu;

/// Writes the record of each triangle of the mesh; see src/scene/compile/geometry.h for
/// the winding. Returns true if some vertex normal differs from its face normal by more
/// than rounding.
bool CompileMesh(const PlacedShape& placed, const WorldFrame& frame,
                 std::uint32_t material, const MeshOutput& out);

/// Returns the box of the points of all curves of a shape, widened by half their width.
Box CurveBox(const Shape& shape, const Transform& transform);

/// Appends the curves of a shape. Throws InputError beyond kMaxCurves, and where the
/// transform flattens them so far that float32 overflows.
void AddCurves(const PlacedShape& placed, const WorldFrame& frame, std::uint32_t material,
               Geometry& geometry);

/// Limit per scene, including copies of instances, that 32-bit offsets can address.
inline constexpr std::size_t kMaxCurves = std::size_t{1} << 26;

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

/// Returns whether hits must be tested against the shape's alpha.
bool IsAlphaTested(const PlacedShape& placed);

}  // namespace lanelight
