// One mesh to triangle records, in place in the arrays of all meshes.
#pragma once

#include <cstdint>

#include "src/base/core/transform.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"

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

}  // namespace lanelight
