// Bilinear patches: surfaces between four points that need not lie in a plane.
#pragma once

#include <array>
#include <optional>

#include "src/base/core/vec.h"
#include "src/scene/description/description.h"

namespace lanelight {

struct QuadSplit {
  bool is_flat = true;    // the corners are coplanar within the rounding of text input
  bool is_simple = true;  // false: the outline crosses itself, no split covers it
  std::array<int, 6> corners;  // two triangles, oriented like the outline
};

/// `ring`: the corners in order around the outline. Splits along the diagonal 0-2, or for
/// an outline that is concave at corner 1 or 3 along 1-3. Collapsed corners are fine.
QuadSplit SplitQuad(const std::array<Vec3d, 4>& ring);

/// How far the triangles of a patch are from it at most, in units of its size (the
/// longest distance of a corner from the first).
inline constexpr double kPatchTolerance = 1e-4;

/// How far interpolated normals are from those of the patch, over the longest.
inline constexpr double kNormalTolerance = 1e-3;

/// Corners in pbrt's order: (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
struct BilinearPatch {
  std::array<Vec3d, 4> p;
  std::optional<std::array<Vec3d, 4>> n;  // to shade with; else those of the surface
  std::array<std::array<double, 2>, 4> uv = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

  Vec3d Point(double u, double v) const;
  /// Along the cross product of the derivatives by u and v; zero where that is.
  Vec3d Normal(double u, double v) const;
};

/// Squares along each side of the patch that keep its triangles within kPatchTolerance,
/// and its normals within kNormalTolerance.
int PatchSteps(const BilinearPatch& patch);

/// Appends the patch to the mesh. It becomes two triangles if it is flat, its outline
/// does not cross itself, and its normals are those of two triangles. Otherwise it
/// becomes a grid with the patch's points, normals and surface coordinates. Flat patches
/// of meshes with curved ones get zero normals, which keeps their faces' normals
/// (src/scene/compile/shape_records.h).
void AddPatch(const BilinearPatch& patch, TriangleMesh* mesh);

}  // namespace lanelight
