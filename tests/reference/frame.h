// Orthonormal frames: local z is the shading normal, local x the surface tangent.
#pragma once

#include <cmath>

#include "src/base/core/vec.h"

namespace lanelight::reference {

struct TangentFrame {
  Vec3d x, y, z;

  Vec3d ToLocal(Vec3d v) const { return {Dot(v, x), Dot(v, y), Dot(v, z)}; }
  Vec3d ToWorld(Vec3d v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Frame with the given unit normal and x axis as close to `tangent` as possible; any
/// tangent if that is parallel to the normal or zero.
inline TangentFrame MakeFrame(Vec3d normal, Vec3d tangent = {}) {
  // Gram-Schmidt; the fallback axis is the coordinate axis least aligned with the normal.
  Vec3d t = tangent - Dot(tangent, normal) * normal;
  if (!(Length(t) > 1e-12 * Length(tangent))) {
    const Vec3d a = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const Vec3d axis = a.x <= a.y && a.x <= a.z ? Vec3d{1, 0, 0}
                       : a.y <= a.z             ? Vec3d{0, 1, 0}
                                                : Vec3d{0, 0, 1};
    t = axis - Dot(axis, normal) * normal;
  }
  const Vec3d x = Normalize(t);
  return {x, Cross(normal, x), normal};
}

}  // namespace lanelight::reference
