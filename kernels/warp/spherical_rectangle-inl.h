// A point on a rectangle uniform over its solid angle.
//   density     1 / omega (solid_angle-inl.h)
//   method      [0, x] x [y0, y1] fills alpha(x) = asin(b0 c) + asin(b1 c), with c = x /
//               |(x, z)|, b1 = y1 / |(y1, z)|, b0 = -y0 / |(y0, z)|. So alpha = alpha(x0)
//               + u0 omega, and x = z sin(alpha) / sqrt((k - h - 2 s^2) (k + h - 2 s^2)),
//               s = sin(alpha / 2), k = 1 + b0 b1, h = sqrt((1 - b0^2) (1 - b1^2)),
//               k - h = (b0 + b1)^2 / (k + h). Given x, y / |(x, y, z)| is uniform
//   error       a rectangle that does not reach over the foot of the receiver has b1 near
//               -b0: sums and differences are then taken from differences of squares. x
//               is the axis along which the rectangle is nearer to the foot, which keeps
//               alpha(x0) below a few omega
//   source      Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for
//               Spherical Rectangles"
#ifndef LANELIGHT_WARP_SPHERICAL_RECTANGLE_INL_H_
#define LANELIGHT_WARP_SPHERICAL_RECTANGLE_INL_H_

#include "kernels/warp/solid_angle-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Two values y0 < y1 and their distances from a point: y1 r0 - y0 r1, without
/// cancellation where they have the same sign. rest2 = r^2 - y^2 of both.
LANELIGHT_INLINE VF CrossedDifference(VF y0, VF r0, VF y1, VF r1, VF rest2) {
  const VF a = hn::Mul(y1, r0), b = hn::Mul(y0, r1);
  const VF squares = hn::Mul(hn::Mul(hn::Sub(y1, y0), hn::Add(y1, y0)), rest2);
  const MF same = hn::Gt(hn::Mul(y0, y1), Splat(0));
  return hn::IfThenElse(same, hn::Div(squares, hn::Add(a, b)), hn::Sub(a, b));
}

/// x of the plane that cuts off the part u of the solid angle.
LANELIGHT_INLINE VF CutRectangle(const LocalRectangle& r, VF omega, VF u) {
  const VF z2 = Sqr(r.z), y00 = Sqr(r.y0), y11 = Sqr(r.y1), y01 = hn::Mul(r.y0, r.y1);
  const VF near2 = hn::MulAdd(r.x0, r.x0, z2);
  const VF r0 = hn::Sqrt(hn::Add(near2, y00)), r1 = hn::Sqrt(hn::Add(near2, y11));
  const VF crossed = CrossedDifference(r.y0, r0, r.y1, r1, near2);
  const VF before = Atan2(hn::Mul(hn::Mul(r.x0, r.z), crossed),
                          hn::MulAdd(hn::Mul(z2, r0), r1, hn::Mul(Sqr(r.x0), y01)));
  const VF alpha = hn::MulAdd(u, omega, before);
  const SinCosPair half = SinCos2Pi(hn::Mul(alpha, Splat(0.0795774715459476679f)));
  const VF q0 = hn::Sqrt(hn::Add(y00, z2)), q1 = hn::Sqrt(hn::Add(y11, z2));
  const VF product = hn::Mul(q0, q1), inverse = hn::Div(Splat(1.0f), product);
  const VF sum = hn::Mul(CrossedDifference(r.y0, q0, r.y1, q1, z2), inverse);
  const VF squares = hn::Div(hn::Mul(z2, hn::Add(z2, hn::Add(y00, y11))),
                             hn::Add(product, hn::Max(y01, Splat(0))));
  const MF same = hn::Gt(y01, Splat(0));
  const VF k = hn::Mul(hn::IfThenElse(same, squares, hn::Sub(product, y01)), inverse);
  const VF upper = hn::MulAdd(z2, inverse, k);
  const VF lower = hn::Div(Sqr(sum), upper);
  const VF twice = hn::Mul(Splat(2.0f), Sqr(half.sin));
  const VF under = hn::Mul(hn::Sub(lower, twice), hn::Sub(upper, twice));
  const VF sine = hn::Mul(Splat(2.0f), hn::Mul(half.sin, half.cos));
  // Rounding may pass the end of the range, which is then the result.
  const VF x = hn::Div(hn::Mul(r.z, sine), hn::Sqrt(hn::Max(under, Splat(1e-37f))));
  return hn::Clamp(x, r.x0, r.x1);
}

/// y for which y / |(x, y, z)| is the part u of its way from y0 to y1; far2 = x^2 + z^2.
LANELIGHT_INLINE VF SampleArc(const LocalRectangle& r, VF far2, VF u) {
  // 1 - |h| and 1 + |h| of h = y / |(x, y, z)|, and from them 1 - h and 1 + h.
  const auto ends = [&](VF y, VF* minus, VF* plus) HWY_ATTR {
    const VF distance = hn::Sqrt(hn::MulAdd(y, y, far2));
    const VF sum = hn::Add(distance, hn::Abs(y));
    const VF large = hn::Div(sum, distance);
    const VF small = hn::Div(far2, hn::Mul(distance, sum));
    const MF positive = hn::Gt(y, Splat(0));
    *minus = hn::IfThenElse(positive, small, large);
    *plus = hn::IfThenElse(positive, large, small);
  };
  VF minus0, plus0, minus1, plus1;
  ends(r.y0, &minus0, &plus0);
  ends(r.y1, &minus1, &plus1);
  const VF minus = hn::MulAdd(u, hn::Sub(minus1, minus0), minus0);
  const VF plus = hn::MulAdd(u, hn::Sub(plus1, plus0), plus0);
  const VF h = hn::Mul(Splat(0.5f), hn::Sub(plus, minus));
  const VF y = hn::Mul(h, hn::Sqrt(hn::Div(far2, hn::Mul(plus, minus))));
  return hn::Clamp(y, r.y0, r.y1);
}

/// A point on the rectangle: distances from its corner (x0, y0) along the two sides.
struct RectanglePoint {
  VF x, y;
};

/// True where u0 goes along y: compared is how far the sides are from the foot of the
/// receiver, which over it is negative.
LANELIGHT_INLINE MF SwapsSides(const LocalRectangle& r) {
  return hn::Gt(hn::Max(r.x0, hn::Neg(r.x1)), hn::Max(r.y0, hn::Neg(r.y1)));
}

/// A rectangle with u0 along x, in units of the longest distance, so that products of
/// lengths stay in range.
struct OrientedRectangle {
  LocalRectangle r;
  MF swap;
  VF reach, scale;

  LANELIGHT_INLINE explicit OrientedRectangle(const LocalRectangle& rectangle)
      : r(rectangle), swap(SwapsSides(rectangle)) {
    Exchange(&r.x0, &r.y0);
    Exchange(&r.x1, &r.y1);
    reach = hn::Max(hn::Max(hn::Abs(r.x0), hn::Abs(r.x1)),
                    hn::Max(hn::Max(hn::Abs(r.y0), hn::Abs(r.y1)), r.z));
    scale = hn::Div(Splat(1.0f), reach);
    for (VF* v : {&r.x0, &r.x1, &r.y0, &r.y1, &r.z}) *v = hn::Mul(*v, scale);
  }
  LANELIGHT_INLINE void Exchange(VF* a, VF* b) const {
    const VF first = hn::IfThenElse(swap, *b, *a);
    *b = hn::IfThenElse(swap, *a, *b);
    *a = first;
  }
};

/// Samples a point for u0, u1 in [0, 1); omega: the solid angle, positive.
LANELIGHT_INLINE RectanglePoint SampleSphericalRectangle(const LocalRectangle& rectangle,
                                                         VF omega, VF u0, VF u1) {
  const OrientedRectangle o(rectangle);
  const VF x = CutRectangle(o.r, omega, u0);
  const VF y = SampleArc(o.r, hn::MulAdd(x, x, Sqr(o.r.z)), u1);
  RectanglePoint out = {hn::Mul(hn::Sub(x, o.r.x0), o.reach),
                        hn::Mul(hn::Sub(y, o.r.y0), o.reach)};
  o.Exchange(&out.x, &out.y);
  return out;
}

/// u0, u1 with which SampleSphericalRectangle finds the point.
LANELIGHT_INLINE UnitSquarePoint InvertSphericalRectangle(const LocalRectangle& rectangle,
                                                          VF omega, RectanglePoint at) {
  const OrientedRectangle o(rectangle);
  const LocalRectangle& r = o.r;
  const VF zero = hn::Zero(DF()), one = Splat(1.0f);
  o.Exchange(&at.x, &at.y);
  const VF width = hn::Sub(r.x1, r.x0), height = hn::Sub(r.y1, r.y0);
  const VF dx = hn::Min(hn::Max(hn::Mul(at.x, o.scale), zero), width);
  const VF dy = hn::Min(hn::Max(hn::Mul(at.y, o.scale), zero), height);
  const VF x = hn::Add(r.x0, dx), y = hn::Add(r.y0, dy);
  LocalRectangle first = r;
  first.x1 = x;
  const VF u0 = hn::Min(hn::Div(first.SolidAngle(dx, height), omega), one);
  const VF far2 = hn::MulAdd(x, x, Sqr(r.z));
  const auto distance = [&](VF v) HWY_ATTR { return hn::Sqrt(hn::MulAdd(v, v, far2)); };
  const VF r0 = distance(r.y0), r1 = distance(r.y1), here = distance(y);
  const VF part = hn::Mul(CrossedDifference(r.y0, r0, y, here, far2), r1);
  const VF whole = hn::Mul(CrossedDifference(r.y0, r0, r.y1, r1, far2), here);
  return {u0, hn::Min(hn::Div(part, hn::Max(whole, Splat(1e-37f))), one)};
}

LANELIGHT_END_KERNELS

#endif
