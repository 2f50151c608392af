// The equal-area octahedral map between the square [0,1]^2 and the sphere (Clarberg 2008,
// "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"; orientation as in pbrt-v4;
// in double: src/base/image/octahedral.h).
#ifndef LANELIGHT_WARP_OCTAHEDRAL_INL_H_
#define LANELIGHT_WARP_OCTAHEDRAL_INL_H_

#include "kernels/simd/math-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Unit direction of a point of the square.
LANELIGHT_INLINE V3 OctahedralDirection(VF s, VF t) {
  const VF one = Splat(1.0f);
  const VF u = hn::MulSub(Splat(2.0f), s, one), v = hn::MulSub(Splat(2.0f), t, one);
  const VF au = hn::Abs(u), av = hn::Abs(v);
  const VF signed_distance = hn::Sub(one, hn::Add(au, av));
  const VF r = hn::Sub(one, hn::Abs(signed_distance));
  // Turns of the azimuth within its quadrant; any value at the pole r = 0.
  const VF ratio =
      hn::IfThenElse(hn::Gt(r, Splat(0)), hn::Div(hn::Sub(av, au), r), Splat(0));
  const VF turns = hn::MulAdd(ratio, Splat(0.125f), Splat(0.125f));
  const auto [sine, cosine] = SinCos2Pi(turns);
  const VF radius = hn::Mul(r, hn::Sqrt(hn::NegMulAdd(r, r, Splat(2.0f))));
  return {hn::CopySign(hn::Mul(cosine, radius), u),
          hn::CopySign(hn::Mul(sine, radius), v),
          hn::CopySign(hn::NegMulAdd(r, r, one), signed_distance)};
}

/// Inverse of OctahedralDirection.
LANELIGHT_INLINE void OctahedralSquare(V3 d, VF* s, VF* t) {
  const VF one = Splat(1.0f), half = Splat(0.5f);
  const VF r = hn::Sqrt(hn::Max(hn::Sub(one, hn::Abs(d.z)), Splat(0)));
  const VF phi = hn::Mul(Atan2(hn::Abs(d.y), hn::Abs(d.x)), Splat(0.636619772367581343f));
  VF v = hn::Mul(phi, r);
  VF u = hn::Sub(r, v);
  const MF below = hn::Lt(d.z, Splat(0));
  const VF folded_u = hn::Sub(one, v), folded_v = hn::Sub(one, u);
  u = hn::CopySign(hn::IfThenElse(below, folded_u, u), d.x);
  v = hn::CopySign(hn::IfThenElse(below, folded_v, v), d.y);
  *s = hn::MulAdd(u, half, half);
  *t = hn::MulAdd(v, half, half);
}

LANELIGHT_END_KERNELS

#endif
