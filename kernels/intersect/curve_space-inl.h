// Rays in the spaces of curves that their transforms stretch or mirror.
//
// As in pbrt-v4, rays meet such curves in object space. Lengths across a ray are those of
// that space, divided by its stretch of the ray, so distances along the ray stay those of
// the scene.
#ifndef LANELIGHT_INTERSECT_CURVE_SPACE_INL_H_
#define LANELIGHT_INTERSECT_CURVE_SPACE_INL_H_

#include "kernels/intersect/curve-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

/// `d` in the space of one curve, of unit length there.
LANELIGHT_INLINE void InCurveSpace(const CurveSpace& space, const float d[3],
                                   float out[3]) {
  const float* m = space.object_from_scene;
  for (int a = 0; a < 3; ++a) {
    out[a] = m[3 * a] * d[0] + m[3 * a + 1] * d[1] + m[3 * a + 2] * d[2];
  }
  const float k = 1 / std::sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  for (int a = 0; a < 3; ++a) out[a] *= k;
}

/// Entries of the maps of the curves of 8 pieces; identities for lanes without one.
struct CurveMaps {
  HWY_ALIGN float m[9][kBvhWidth];

  LANELIGHT_INLINE CurveMaps(const Geometry& geometry, const CurveBlock& block) {
    const uint32_t first = geometry.ranges.curves;
    const uint32_t count = static_cast<uint32_t>(geometry.curve_spaces.size());
    for (int lane = 0; lane < kBvhWidth; ++lane) {
      const uint32_t curve = std::min(block.prim[lane] - first, count - 1);
      for (int k = 0; k < 9; ++k) {
        m[k][lane] = geometry.curve_spaces[curve].object_from_scene[k];
      }
    }
  }
};

/// Pieces i and further of a block as a ray sees them in their spaces.
LANELIGHT_INLINE VisiblePieces<V8> PiecesInSpaces(const CurveMaps& maps,
                                                  const CurveBlock& block, int i,
                                                  const CurveRay& ray) {
  const D8 d8;
  P3<V8> row[3], column[3];
  for (int a = 0; a < 3; ++a) {
    const auto at = [&](int r, int c)
                        HWY_ATTR { return hn::Load(d8, maps.m[3 * r + c] + i); };
    row[a] = {at(a, 0), at(a, 1), at(a, 2)};
    column[a] = {at(0, a), at(1, a), at(2, a)};
  }
  const V8 one = hn::Set(d8, 1.0f);
  P3<V8> z = {Dot(row[0], ray.z), Dot(row[1], ray.z), Dot(row[2], ray.z)};
  const V8 k = hn::Div(one, hn::Sqrt(Dot(z, z)));
  z = {hn::Mul(z.x, k), hn::Mul(z.y, k), hn::Mul(z.z, k)};
  // As FrameFromNormal.
  const V8 sign = hn::CopySign(one, z.z), a = hn::Neg(hn::Div(one, hn::Add(sign, z.z)));
  const V8 b = hn::Mul(hn::Mul(z.x, z.y), a), sign_x = hn::Mul(sign, z.x);
  const P3<V8> x = {hn::MulAdd(sign_x, hn::Mul(z.x, a), one), hn::Mul(sign, b),
                    hn::Neg(sign_x)};
  const P3<V8> y = {b, hn::MulAdd(hn::Mul(z.y, z.y), a, sign), hn::Neg(z.y)};
  // Back to directions of the scene.
  const auto back = [&](P3<V8> v) HWY_ATTR {
    return P3<V8>{hn::Mul(Dot(column[0], v), k), hn::Mul(Dot(column[1], v), k),
                  hn::Mul(Dot(column[2], v), k)};
  };
  VisiblePieces<V8> seen = PiecesAlong(block, i, {ray.o, back(x), back(y), back(z)});
  for (V8& radius : seen.radius) radius = hn::Mul(radius, k);
  return seen;
}

LANELIGHT_END_KERNELS

#endif
