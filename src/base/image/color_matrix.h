// 3x3 colour matrices from chromaticities.
#pragma once

#include "src/base/core/vec.h"

namespace lanelight {

struct Chromaticity {
  double x, y;
  constexpr Vec3d Xyz() const { return {x / y, 1, (1 - x - y) / y}; }  // with Y = 1
};

inline constexpr Chromaticity kD65White = {0.3127, 0.3290};

struct ColorMatrix {
  Vec3d row[3];

  Vec3d operator*(Vec3d v) const {
    return {Dot(row[0], v), Dot(row[1], v), Dot(row[2], v)};
  }
};

/// Inverse by cofactors; the matrices here are far from singular.
inline ColorMatrix Inverse(const ColorMatrix& m) {
  const Vec3d c0 = Cross(m.row[1], m.row[2]), c1 = Cross(m.row[2], m.row[0]),
              c2 = Cross(m.row[0], m.row[1]);
  const double d = 1 / Dot(m.row[0], c0);
  return {{Vec3d{c0.x, c1.x, c2.x} * d, Vec3d{c0.y, c1.y, c2.y} * d,
           Vec3d{c0.z, c1.z, c2.z} * d}};
}

/// XYZ of linear rgb whose primaries are r, g, b and whose (1, 1, 1) is white with Y = 1
/// (SMPTE RP 177-1993).
inline ColorMatrix XyzFromPrimaries(Chromaticity r, Chromaticity g, Chromaticity b,
                                    Chromaticity white) {
  const Vec3d R = r.Xyz(), G = g.Xyz(), B = b.Xyz();
  const ColorMatrix primaries = {{{R.x, G.x, B.x}, {R.y, G.y, B.y}, {R.z, G.z, B.z}}};
  const Vec3d s = Inverse(primaries) * white.Xyz();
  return {{{R.x * s.x, G.x * s.y, B.x * s.z},
           {R.y * s.x, G.y * s.y, B.y * s.z},
           {R.z * s.x, G.z * s.y, B.z * s.z}}};
}

inline ColorMatrix XyzFromSrgb() {
  return XyzFromPrimaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65White);
}

}  // namespace lanelight
