// Irradiance from lights of radiance 1, in closed form and in double precision: the
// expectation of the control variate control=analytic. The light is seen from the origin
// by a receiver of unit normal n, and clipped at the receiver's horizon.
//   polygon   1/2 |sum over edges of angle(a, b) n.(a x b)/|a x b|| (Lambert 1760). The
//             terms of a small light cancel, which costs a relative error of about
//             u d / size with u = 2^-53; every difference of corners is taken before the
//             receiver's place comes in, so that it is not the square of that.
//   sphere    with H = d / r, x = sqrt(H^2 - 1), b the angle to the centre,
//             y = -x cot b in [-1, 1], A = sin b sqrt(1 - y^2), t = A / x:
//             (cos b acos y + t) / H^2 - (t - atan t); y = -1 wholly above, 1 below
//   disk      see DiskIrradiance
// Errors against quadrature, relative to the irradiance of a receiver that faces the
// light: below 5e-7 (tests/control/irradiance_test.cc), which is the rounding of the
// result and of the normal to float.
#ifndef LANELIGHT_CONTROL_IRRADIANCE_INL_H_
#define LANELIGHT_CONTROL_IRRADIANCE_INL_H_

#include "hwy/contrib/math/math-inl.h"
#include "kernels/surface/point-inl.h"

LANELIGHT_BEGIN_KERNELS

using MD = hn::Mask<DD>;

LANELIGHT_INLINE VD SplatD(double v) { return hn::Set(DD(), v); }
LANELIGHT_INLINE D3 SplatD3(const float* v) {
  return {SplatD(v[0]), SplatD(v[1]), SplatD(v[2])};
}
LANELIGHT_INLINE D3 Plus(D3 a, D3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
LANELIGHT_INLINE D3 Scaled(D3 a, VD s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
LANELIGHT_INLINE D3 Cross(D3 a, D3 b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)),
          hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
LANELIGHT_INLINE D3 Select(MD m, D3 a, D3 b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y),
          hn::IfThenElse(m, a.z, b.z)};
}
LANELIGHT_INLINE VD SqrtPositive(VD v) { return hn::Sqrt(hn::Max(v, SplatD(0))); }

/// Angle in [0, pi] of the point (c, s), s >= 0; 0 at the origin.
LANELIGHT_INLINE VD UpperAngle(VD s, VD c) {
  const double pi = 3.14159265358979323846;
  const VD size = hn::Abs(c);
  const VD high = hn::Max(hn::Max(s, size), SplatD(1e-300));
  const VD small = hn::Atan(DD(), hn::Div(hn::Min(s, size), high));
  const VD quarter =
      hn::IfThenElse(hn::Gt(s, size), hn::Sub(SplatD(0.5 * pi), small), small);
  return hn::IfThenElse(hn::Lt(c, SplatD(0)), hn::Sub(SplatD(pi), quarter), quarter);
}

/// The corners of a triangle: one of them, and the edges that lead from it around.
struct LightEdges {
  D3 corner, e01, e12;
};

/// Sum over the edges of a polygon while it is clipped at the plane n.v = 0.
struct HorizonClip {
  D3 n;
  VD sum = SplatD(0);
  // Where the outline sinks below the horizon and where it rises again, from the first
  // corner.
  D3 sets = {SplatD(0), SplatD(0), SplatD(0)}, rises = sets;

  LANELIGHT_INLINE explicit HorizonClip(D3 normal) : n(normal) {}

  LANELIGHT_INLINE void Add(D3 a, D3 edge, VD from, VD to) {
    const D3 cross = Cross(a, edge);
    const VD s = hn::Mul(hn::Sub(to, from), hn::Sqrt(Dot(cross, cross)));
    const VD c = Dot(MulAdd(edge, from, a), MulAdd(edge, to, a));
    const VD term = hn::Div(hn::Mul(UpperAngle(s, c), Dot(n, cross)),
                            hn::Max(hn::Sqrt(Dot(cross, cross)), SplatD(1e-300)));
    sum = hn::Add(sum, hn::IfThenElseZero(hn::Gt(s, SplatD(0)), term));
  }

  /// The edge from first + offset to first + offset + edge, of heights za and zb.
  LANELIGHT_INLINE void AddClipped(D3 first, D3 offset, D3 edge, VD za, VD zb) {
    const VD zero = SplatD(0), one = SplatD(1);
    const MD above_a = hn::Gt(za, zero), above_b = hn::Gt(zb, zero);
    const MD crosses = hn::Xor(above_a, above_b);
    const VD at = hn::Div(za, hn::IfThenElse(crosses, hn::Sub(za, zb), one));
    const VD from = hn::IfThenElse(above_a, zero, at);
    const VD to = hn::IfThenElse(above_b, one, at);
    const VD end = hn::IfThenElse(hn::Or(above_a, above_b), to, from);
    Add(Plus(first, offset), edge, from, end);
    const D3 point = MulAdd(edge, at, offset);
    sets = Select(hn::And(crosses, above_a), point, sets);
    rises = Select(hn::And(crosses, above_b), point, rises);
  }

  /// Closes the outline along the horizon.
  LANELIGHT_INLINE VD Irradiance(D3 first) {
    const D3 edge = Minus(rises, sets);
    if (!hn::AllTrue(DD(), hn::Eq(Dot(edge, edge), SplatD(0)))) {
      Add(Plus(first, sets), edge, SplatD(0), SplatD(1));
    }
    return hn::Mul(SplatD(0.5), hn::Abs(sum));
  }
};

LANELIGHT_INLINE VD TriangleIrradiance(const LightEdges& t, D3 n) {
  const D3 e02 = Plus(t.e01, t.e12);
  const VD z0 = Dot(n, t.corner);
  const VD z1 = hn::Add(z0, Dot(n, t.e01)), z2 = hn::Add(z0, Dot(n, e02));
  if (hn::AllTrue(DD(), hn::Le(hn::Max(z0, hn::Max(z1, z2)), SplatD(0)))) {
    return SplatD(0);
  }
  const D3 zero = {SplatD(0), SplatD(0), SplatD(0)};
  HorizonClip clip(n);
  clip.AddClipped(t.corner, zero, t.e01, z0, z1);
  clip.AddClipped(t.corner, t.e01, t.e12, z1, z2);
  clip.AddClipped(t.corner, e02, Minus(zero, e02), z2, z0);
  return clip.Irradiance(t.corner);
}

/// t - atan(t) for t = s / c >= 0. Relative error below 1e-8.
LANELIGHT_INLINE VD TMinusAtan(VD t, VD s, VD c) {
  const VD t2 = hn::Mul(t, t);
  VD series = hn::NegMulAdd(t2, SplatD(1.0 / 9), SplatD(1.0 / 7));
  series = hn::NegMulAdd(t2, series, SplatD(1.0 / 5));
  series = hn::NegMulAdd(t2, series, SplatD(1.0 / 3));
  return hn::IfThenElse(hn::Lt(t, SplatD(0.1)), hn::Mul(hn::Mul(t, t2), series),
                        hn::Sub(t, UpperAngle(s, c)));
}

/// A sphere seen from outside.
LANELIGHT_INLINE VD SphereIrradiance(D3 center, VD radius, D3 n) {
  const VD one = SplatD(1), r2 = hn::Mul(radius, radius), d2 = Dot(center, center);
  const VD d = hn::Sqrt(d2), sin2 = hn::Div(r2, d2);
  const D3 across = Cross(n, center);
  const VD cosine = hn::Div(Dot(n, center), d);
  const VD sine = hn::Div(hn::Sqrt(Dot(across, across)), d);
  const VD x = hn::Div(SqrtPositive(hn::Sub(d2, r2)), radius);
  const VD cot = hn::Div(hn::Mul(x, cosine), hn::Max(sine, SplatD(1e-30)));
  const VD y = hn::Clamp(hn::Neg(cot), SplatD(-1), one);
  const VD root = hn::Sqrt(hn::Mul(hn::Sub(one, y), hn::Add(one, y)));
  const VD a = hn::Mul(sine, root), t = hn::Div(a, hn::Max(x, SplatD(1e-30)));
  const VD seen = hn::MulAdd(cosine, UpperAngle(root, y), t);
  return hn::Max(hn::MulSub(seen, sin2, TMinusAtan(t, a, x)), SplatD(0));
}

/// A disk of unit normal `axis` whose centre lies at `center`, wholly above the horizon.
/// With h its distance from the receiver along the axis and a across it, r its radius,
/// Z = a^2 + h^2 + r^2, q = Z - 2 r^2, s = sqrt(q^2 + 4 h^2 r^2) = sqrt(Z^2 - 4 a^2 r^2):
///   along the axis   pi (1 - q / s) / 2
///   across           pi 2 h a r^2 / (s (Z + s))
/// (By Stokes' theorem the vector irradiance is half the integral of x cross dx / |x|^2
/// along the rim, which is elementary for a circle.)
LANELIGHT_INLINE VD DiskIrradiance(D3 center, D3 axis, VD radius, D3 n) {
  const double pi = 3.14159265358979323846;
  const VD r2 = hn::Mul(radius, radius), along = Dot(axis, center);
  const D3 across = MulAdd(axis, hn::Neg(along), center);
  const VD h2 = hn::Mul(along, along), a2 = Dot(across, across);
  const VD q = hn::Sub(hn::Add(a2, h2), r2);
  const VD four = hn::Mul(SplatD(4), hn::Mul(h2, r2));
  const VD s = hn::Max(hn::Sqrt(hn::MulAdd(q, q, four)), SplatD(1e-300));
  const VD z = hn::Add(hn::Add(a2, h2), r2);
  // s - q, without cancellation for small disks.
  const VD rest =
      hn::IfThenElse(hn::Gt(q, SplatD(0)), hn::Div(four, hn::Add(s, q)), hn::Sub(s, q));
  const VD parallel = hn::Div(hn::Mul(SplatD(0.5 * pi), rest), s);
  const VD lateral = hn::Div(hn::Mul(SplatD(2 * pi), hn::Mul(hn::Abs(along), r2)),
                             hn::Mul(s, hn::Add(z, s)));
  const VD toward = hn::CopySign(Dot(axis, n), hn::Mul(along, Dot(axis, n)));
  return hn::Max(hn::MulAdd(toward, parallel, hn::Mul(Dot(n, across), lateral)),
                 SplatD(0));
}

LANELIGHT_END_KERNELS

#endif
