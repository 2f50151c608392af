// Shapes to primitive records: positions in double precision up to one rounding to float.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

// Orientation of triangles. pbrt-v4 transforms the vertices, takes the cross product of
// the edges of the *transformed* triangle, and turns it round if ReverseOrientation XOR
// the transform mirrors. A mirroring transform already reverses that cross product
// relative to the transformed object-space normal (cross(Ma, Mb) = det(M) M^-T cross(a,
// b)), so the rule says: the object-space face normal is carried along as a normal,
// mirror or not, and ReverseOrientation turns it round. Our records have no flag, so
// vertices 1 and 2 swap places exactly where pbrt turns the cross product round.
//
// With vertex normals (transformed by M^-T, negated by ReverseOrientation) pbrt instead
// turns the face normal to the side of the interpolated shading normal, whatever the
// winding. Here the side is chosen once per triangle, by the sum of its vertex normals;
// if that sum lies in the triangle's plane the rule above decides.

/// The triangles of one placed mesh.
struct MeshRange {
  std::uint32_t begin = 0, end = 0;  // of Geometry::triangles
  std::uint32_t dropped = 0;  // degenerate ones: no area after rounding, not finite
  // Of emitting meshes, per triangle, before rounding: its own, and that of the face of
  // the file, or the round shape, that it is a part of.
  std::vector<double> areas, face_areas;
};

struct CompiledGeometry {
  Geometry geometry;
  std::vector<MeshRange> meshes;                      // as Placement::meshes
  std::vector<std::vector<MeshRange>> object_meshes;  // as Placement::objects
};

/// Calls visit(placed, begin, end) for everything placed, in the order of ForEachPlaced,
/// with the primitives that it has become.
template <typename Visit>
void ForEachCompiled(const Placement& placement, const CompiledGeometry& compiled,
                     const Visit& visit) {
  std::vector<const MeshRange*> meshes;
  for (const MeshRange& range : compiled.meshes) meshes.push_back(&range);
  for (const auto& object : compiled.object_meshes) {
    for (const MeshRange& range : object) meshes.push_back(&range);
  }
  auto mesh = meshes.begin();
  std::uint32_t next = compiled.geometry.ranges.spheres;  // the rest follow each other
  ForEachPlaced(placement, [&](const PlacedShape& placed) {
    if (mesh == meshes.end()) {
      const auto& curves = placed.shape->curves;
      const std::size_t count = curves == nullptr ? 1 : curves->size();
      const std::uint32_t begin = next;
      next += static_cast<std::uint32_t>(count);
      visit(placed, begin, next);
    } else {
      visit(placed, (*mesh)->begin, (*mesh)->end);
      ++mesh;
    }
  });
}

/// `material_index` maps described to compiled materials. Texture coordinates are stored
/// with `keep_uvs`. Lights are left at -1.
/// Throws InputError for quadrics under transforms that do not keep their shape.
CompiledGeometry CompileGeometry(const Placement& placement,
                                 const std::vector<std::int32_t>& material_index,
                                 bool keep_uvs);

}  // namespace lanelight
