#include "src/scene/parse/quad.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

double LargestComponent(Vec3d v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool IsFlat(const std::array<Vec3d, 4>& ring, Vec3d across, Vec3d along, double unit) {
  const Vec3d normal = Normalize(Cross(across, along));
  // Six digits of text input: errors of 1e-6 of the coordinates themselves.
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
  // Lengths in units of the quad itself, so that products neither over- nor underflow.
  const Vec3d a = (ring[1] - ring[0]) / unit, b = (ring[2] - ring[0]) / unit;
  const Vec3d c = (ring[3] - ring[0]) / unit;
  split.is_flat = IsFlat(ring, b, c - a, unit);
  if (Dot(Cross(a, b), Cross(b, c)) >= 0) return split;
  split.corners = {0, 1, 3, 1, 2, 3};
  split.is_simple = Dot(Cross(a, c), Cross(b - a, c - a)) >= 0;
  return split;
}

}  // namespace lanelight
