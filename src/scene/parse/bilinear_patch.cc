#include "src/scene/parse/bilinear_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanelight {
namespace {

constexpr std::array<int, 4> kRing = {0, 1, 3, 2};  // corners around the outline

template <typename T>
T Mix(const std::array<T, 4>& corners, double u, double v) {
  return (corners[0] * (1 - u) + corners[1] * u) * (1 - v) +
         (corners[2] * (1 - u) + corners[3] * u) * v;
}

std::array<double, 2> MixUv(const BilinearPatch& patch, double u, double v) {
  std::array<double, 2> out;
  for (std::size_t i = 0; i < 2; ++i) {
    std::array<double, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = patch.uv[k][i];
    out[i] = Mix(corners, u, v);
  }
  return out;
}

// Distance of the corners from a parallelogram. In a cell of the grid, the patch differs
// from its two triangles by a quarter of the twist there, 1 / steps^2 of the whole.
double Twist(const std::array<Vec3d, 4>& corners) {
  return Length(corners[0] - corners[1] - corners[2] + corners[3]);
}

// Squares along each side that keep interpolated normals within kNormalTolerance. Where
// they change evenly, those of two triangles are those of the patch, unless their lengths
// differ: triangles have unit normals.
double NormalSteps(const std::array<Vec3d, 4>& normals) {
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const Vec3d& n : normals) {
    longest = std::max(longest, Length(n));
    shortest = std::min(shortest, Length(n));
  }
  const double off = (Twist(normals) + longest - shortest) / longest;
  if (!std::isfinite(off)) return 1;
  return std::sqrt(off / (4 * kNormalTolerance));
}

void AddVertex(const BilinearPatch& patch, double u, double v, bool with_normal,
               TriangleMesh* mesh) {
  mesh->positions.push_back(patch.Point(u, v));
  mesh->uvs.push_back(MixUv(patch, u, v));
  if (!with_normal) return;
  mesh->normals.push_back(patch.n ? Normalize(Mix(*patch.n, u, v)) : patch.Normal(u, v));
}

void AddFlat(const BilinearPatch& patch, const QuadSplit& split, TriangleMesh* mesh) {
  const auto base = static_cast<std::uint32_t>(mesh->positions.size());
  for (int corner : kRing) {
    AddVertex(patch, corner % 2, corner / 2, patch.n.has_value(), mesh);
  }
  for (int corner : split.corners) {
    mesh->indices.push_back(base + static_cast<std::uint32_t>(corner));
  }
}

void AddGrid(const BilinearPatch& patch, TriangleMesh* mesh) {
  const auto base = static_cast<std::uint32_t>(mesh->positions.size());
  const auto steps = static_cast<std::uint32_t>(PatchSteps(patch));
  mesh->normals.resize(base);  // flat patches before this one
  for (std::uint32_t j = 0; j <= steps; ++j) {
    for (std::uint32_t i = 0; i <= steps; ++i) {
      AddVertex(patch, static_cast<double>(i) / steps, static_cast<double>(j) / steps,
                true, mesh);
    }
  }
  for (std::uint32_t j = 0; j < steps; ++j) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      const std::uint32_t a = base + j * (steps + 1) + i, b = a + steps + 1;
      mesh->indices.insert(mesh->indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
}

bool IsFlat(const std::array<Vec3d, 4>& ring, Vec3d across, Vec3d along, double unit) {
  const Vec3d normal = Normalize(Cross(across, along));
  // Text input of six digits has relative errors of 1e-6.
  double tolerance = 1e-5;
  for (const Vec3d& p : ring) {
    tolerance = std::max(tolerance, 4e-6 * LargestComponent(p) / unit);
  }
  for (int i = 1; i < 4; ++i) {
    if (std::abs(Dot(normal, (ring[i] - ring[0]) / unit)) > tolerance) return false;
  }
  return true;
}

}  // namespace

QuadSplit SplitQuad(const std::array<Vec3d, 4>& ring) {
  QuadSplit split;
  split.corners = {0, 1, 2, 0, 2, 3};
  double unit = 0;
  for (int i = 1; i < 4; ++i) unit = std::max(unit, LargestComponent(ring[i] - ring[0]));
  if (!(unit > 0) || !std::isfinite(unit)) return split;
  // Scaled by the size of the quad, so that products neither over- nor underflow.
  const Vec3d a = (ring[1] - ring[0]) / unit, b = (ring[2] - ring[0]) / unit;
  const Vec3d c = (ring[3] - ring[0]) / unit;
  split.is_flat = IsFlat(ring, b, c - a, unit);
  if (Dot(Cross(a, b), Cross(b, c)) >= 0) return split;
  split.corners = {0, 1, 3, 1, 2, 3};
  split.is_simple = Dot(Cross(a, c), Cross(b - a, c - a)) >= 0;
  return split;
}

Vec3d BilinearPatch::Point(double u, double v) const { return Mix(p, u, v); }

Vec3d BilinearPatch::Normal(double u, double v) const {
  const Vec3d along_u = (p[1] - p[0]) * (1 - v) + (p[3] - p[2]) * v;
  const Vec3d along_v = (p[2] - p[0]) * (1 - u) + (p[3] - p[1]) * u;
  return Normalize(Cross(Normalize(along_u), Normalize(along_v)));
}

int PatchSteps(const BilinearPatch& patch) {
  double size = 0;
  for (const Vec3d& corner : patch.p) size = std::max(size, Length(corner - patch.p[0]));
  const double twist = Twist(patch.p) / size;
  if (!(size > 0) || !std::isfinite(twist)) return 1;
  double steps = std::sqrt(twist / (4 * kPatchTolerance));
  if (patch.n) steps = std::max(steps, NormalSteps(*patch.n));
  return std::max(1, static_cast<int>(std::ceil(steps)));
}

void AddPatch(const BilinearPatch& patch, TriangleMesh* mesh) {
  std::array<Vec3d, 4> ring;
  for (std::size_t i = 0; i < 4; ++i) {
    ring[i] = patch.p[static_cast<std::size_t>(kRing[i])];
  }
  const QuadSplit split = SplitQuad(ring);
  const bool even = !patch.n || PatchSteps(patch) == 1;
  if (split.is_flat && split.is_simple && even) {
    AddFlat(patch, split, mesh);
  } else {
    AddGrid(patch, mesh);
  }
  mesh->rotates_tangents |= patch.n.has_value();
  if (!mesh->normals.empty()) mesh->normals.resize(mesh->positions.size());
  mesh->continues.push_back(false);
  mesh->continues.resize(mesh->indices.size() / 3, true);
}

}  // namespace lanelight
