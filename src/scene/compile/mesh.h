// One mesh to triangle records, in place in the arrays of all meshes.
#pragma once

#include <cstdint>

#include "src/base/core/transform.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Where the triangles of one mesh go. `normals` and `uvs` may be null: then they are not
/// stored. `areas` may be null: otherwise it gets the areas before rounding.
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
