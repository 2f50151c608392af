// A point on a triangle uniform over its solid angle.
//   density     1 / omega (solid_angle-inl.h)
//   method      u0 cuts off the triangle v0, v1, w, with w on the arc from v0 to v2. If
//               w is the reflection of v0 about a direction m, the tangent of half its
//               solid angle is det(v0, v1, m) / (m (v0 + v1)), linear in m. So
//               m = (det cos h - (v0 + v1) v2 sin h) v0 + (1 + v0 v1) sin h v2,
//               h = u0 omega / 2. On the arc from v1 to w, points are uniform in the
//               cosine to v1
//   error       of the direction 4e-7, whatever the size: cosines near 1 are never
//               subtracted from each other, only points from points
//   source      Arvo 1995, "Stratified Sampling of Spherical Triangles"; the arc by
//               reflection: Peters 2021, "BRDF Importance Sampling for Polygonal Lights"
#ifndef LANELIGHT_WARP_SPHERICAL_TRIANGLE_INL_H_
#define LANELIGHT_WARP_SPHERICAL_TRIANGLE_INL_H_

#include "kernels/warp/solid_angle-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A direction (of length 1 but for rounding) inside the triangle, for u0, u1 in [0, 1).
/// omega: its solid angle, positive.
LANELIGHT_INLINE V3 SampleSphericalTriangle(const SphericalTriangle& t, VF omega, VF u0,
                                            VF u1) {
  const float inv_four_pi = 0.0795774715459476679f;
  const SinCosPair h = SinCos2Pi(hn::Mul(hn::Mul(u0, omega), Splat(inv_four_pi)));
  const VF a = hn::NegMulAdd(t.sum_01_2, h.sin, hn::Mul(t.det, h.cos));
  const VF b = hn::Mul(t.one_and_01, h.sin);
  const V3 m = MulAdd(t.v0, a, Mul(t.v2, b));
  const VF along = hn::Div(hn::Mul(Splat(2.0f), Dot(m, t.v0)), Dot(m, m));
  const V3 turned = Mul(m, along);
  const V3 step = turned - (t.v0 + t.v1);  // from v1 to w
  const V3 sum = turned + (t.v1 - t.v0);   // of v1 and w
  // 1 - cosine to v1: of w, and of the sample.
  const VF far = hn::Mul(Splat(0.5f), Dot(step, step)), near = hn::Mul(u1, far);
  // 1 + the cosine, likewise: nothing is left of it where w is opposite to v1.
  const VF far_rest = hn::Mul(Splat(0.5f), Dot(sum, sum));
  const VF near_rest = hn::MulAdd(far, hn::Sub(Splat(1.0f), u1), far_rest);
  const VF ratio = hn::Div(hn::Mul(u1, near_rest), far_rest);
  const VF sine = SafeSqrt(ratio);  // of the sample over that of w
  const VF rest = hn::MulAdd(sine, far, hn::Sub(Splat(1.0f), near));
  return MulAdd(t.v1, rest, Mul(step, sine));
}

/// u0, u1 with which SampleSphericalTriangle finds the point of barycentric weights b1,
/// b2 of corners 1 and 2. The line from corner 1 through it cuts off u0; lengths are in
/// units of the distance of that corner.
LANELIGHT_INLINE UnitSquarePoint InvertSphericalTriangle(V3 to_corner, V3 e1, V3 e2,
                                                         VF omega, VF b1, VF b2) {
  const VF zero = hn::Zero(DF()), one = Splat(1.0f), tiny = Splat(1e-30f);
  const VF away = hn::Min(hn::Max(hn::Sub(one, b1), tiny), one);
  const VF cut = hn::Min(hn::Max(hn::Div(b2, away), zero), one);
  const SphericalTriangle first(to_corner, e1, Mul(e2, cut));
  const VF u0 = hn::Min(hn::Div(first.SolidAngle(), omega), one);
  const V3 corner = to_corner + e1;
  const VF unit = Rsqrt(Dot(corner, corner));
  const V3 a = Mul(corner, unit), along = Mul(MulAdd(e2, cut, -e1), unit);
  const V3 cross = Cross(a, along);
  const VF cross2 = Dot(cross, cross);
  // 1 - the cosine of the angle between a and a + part * along.
  const auto versine = [&](VF part) HWY_ATTR {
    const V3 to = MulAdd(along, part, a);
    const VF length = hn::Sqrt(Dot(to, to)), dot = Dot(a, to);
    const VF difference = hn::Sub(length, dot);
    const VF squares = hn::Div(hn::Mul(Sqr(part), cross2), hn::Add(length, dot));
    const MF acute = hn::Gt(dot, zero);
    return hn::Div(hn::IfThenElse(acute, squares, difference), hn::Max(length, tiny));
  };
  const VF u1 = hn::Div(versine(away), hn::Max(versine(one), tiny));
  return {u0, hn::Min(u1, one)};
}

LANELIGHT_END_KERNELS

#endif
