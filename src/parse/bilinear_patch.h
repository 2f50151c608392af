// Bilinear patches: surfaces between four points that need not lie in a plane.
#pragma once

#include <array>
#include <optional>

#include "src/scene/description.h"

namespace lanelight {

/// How far the triangles of a patch are from it at most, in units of its size (the
/// longest distance of a corner from the first).
inline constexpr double kPatchTolerance = 1e-4;

/// Corners in pbrt's order: (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
struct BilinearPatch {
  std::array<Vec3d, 4> p;
  std::optional<std::array<Vec3d, 4>> n;  // to shade with; else those of the surface
  std::array<std::array<double, 2>, 4> uv = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

  Vec3d Point(double u, double v) const;
  /// Along the cross product of the derivatives by u and v; zero where that is.
  Vec3d Normal(double u, double v) const;
};

/// Squares along each side of the patch that keep its triangles within kPatchTolerance.
int PatchSteps(const BilinearPatch& patch);

/// Appends the patch to the mesh: two triangles if it is flat and its outline does not
/// cross itself, else a grid whose vertices have the patch's points, normals and surface
/// coordinates. Meshes with some curved patches have zero normals at flat ones, which
/// leaves their faces' own (src/compile/mesh.h).
void AddPatch(const BilinearPatch& patch, TriangleMesh* mesh);

}  // namespace lanelight
