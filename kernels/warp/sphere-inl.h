// Points of the unit disk, by the concentric map (Shirley and Chiu 1997), which preserves
// area and neighbourhoods, so stratified points stay stratified. Directions on the
// hemisphere around +z, with densities with respect to solid angle. No sampler returns a
// direction with z = 0, where the density of two of them vanishes. The octahedral
// map of the sphere is at the end.
#ifndef LANELIGHT_WARP_SPHERE_INL_H_
#define LANELIGHT_WARP_SPHERE_INL_H_

#include "kernels/simd/math-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

struct V2 {
  VF x, y;
};

/// Point of the unit disk for (u0, u1) in [0,1]^2. The square's concentric squares become
/// circles: radius = the larger of |a|, |b| with (a, b) = 2u - 1, and the angle is 45
/// degrees times the ratio of the smaller to the larger.
HWY_INLINE V2 SampleDisk(VF u0, VF u1) {
  const VF one = Splat(1.0f);
  const VF a = hn::MulSub(Splat(2.0f), u0, one);
  const VF b = hn::MulSub(Splat(2.0f), u1, one);
  const MF a_longer = hn::Gt(hn::Abs(a), hn::Abs(b));
  const VF longer = hn::IfThenElse(a_longer, a, b);
  const VF shorter = hn::IfThenElse(a_longer, b, a);
  const VF divisor = hn::IfThenElse(hn::Eq(longer, hn::Zero(DF())), one, longer);
  const SinCosPair octant = SinCosOctant(hn::Div(hn::Mul(Splat(0.5f), shorter), divisor));
  const VF along = hn::Mul(longer, octant.cos), across = hn::Mul(longer, octant.sin);
  return {hn::IfThenElse(a_longer, along, across),
          hn::IfThenElse(a_longer, across, along)};
}

/// Density cos / pi: a uniform point of the disk, lifted (Malley's method). u in [0,1]^2.
HWY_INLINE V3 SampleCosineHemisphere(VF u0, VF u1) {
  const V2 p = SampleDisk(u0, u1);
  const VF z2 = hn::NegMulAdd(p.x, p.x, hn::NegMulAdd(p.y, p.y, Splat(1.0f)));
  // Half the spacing of the disk's edge in [0,1) points of 24 bits.
  return {p.x, p.y, hn::Sqrt(hn::Max(z2, Splat(0x1p-24f)))};
}
HWY_INLINE VF PdfCosineHemisphere(VF cos_theta) {
  return hn::Mul(cos_theta, Splat(kInvPi));
}

/// Direction of height z and azimuth 2 pi u1, given sin^2 of its polar angle.
HWY_INLINE V3 FromHeight(VF z, VF sin2, VF u1) {
  const SinCosPair phi = SinCos2Pi(u1);
  const VF r = SafeSqrt(sin2);
  return {hn::Mul(r, phi.cos), hn::Mul(r, phi.sin), z};
}

/// Density 1 / (2 pi): heights of a sphere's zone are uniform (Archimedes). u in [0,1)^2.
HWY_INLINE V3 SampleUniformHemisphere(VF u0, VF u1) {
  return FromHeight(hn::Sub(Splat(1.0f), u0), hn::Mul(u0, hn::Sub(Splat(2.0f), u0)), u1);
}
HWY_INLINE VF PdfUniformHemisphere() { return Splat(0.5f * kInvPi); }

/// Density 2 cos^3 / pi: the direction of "normal + uniform point of the unit ball".
/// Seen from the foot of the normal the ball has radius 1 and centre +z, so it fills the
/// ray at polar angle theta from 0 to 2 cos; the volume per solid angle is
/// integral r^2 dr = 8 cos^3 / 3, and divided by the ball's 4 pi / 3 that is 2 cos^3 /
/// pi. In the height the distribution function is z^4. u in [0,1)^2.
HWY_INLINE V3 SampleInSphere(VF u0, VF u1) {
  const VF z2 = hn::Sqrt(hn::Sub(Splat(1.0f), u0));
  // 1 - z2 without cancellation: 1 - sqrt(1 - u) = u / (1 + sqrt(1 - u)).
  const VF sin2 = hn::Div(u0, hn::Add(Splat(1.0f), z2));
  return FromHeight(hn::Sqrt(z2), sin2, u1);
}
HWY_INLINE VF PdfInSphere(VF cos_theta) {
  return hn::Mul(Splat(2.0f * kInvPi), hn::Mul(cos_theta, Sqr(cos_theta)));
}

// The equal-area octahedral map between the square [0,1]^2 and the sphere (Clarberg 2008,
// "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"; orientation as in pbrt-v4;
// in double: src/base/image/octahedral.h).

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

/// Inverts OctahedralDirection.
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
