// Solid angles of triangles and rectangles, without cancellation: from tiny ones to such
// that surround the receiver.
//   method      tan(omega / 2) = det / (1 + v0 v1 + v1 v2 + v2 v0) of unit vectors v,
//               with det from the edges over the distances, and the rest as
//               s s / 2 + s v2, s = v0 + v1; a rectangle is two triangles, added as
//               complex numbers
//   error       below 2e-6 (1 + 1 / c) relative, c: height over the distance of corner 0;
//               tests/kernels/lights/solid_angle_test.cc asserts it. The second part is
//               the rounding of the height, which area sampling meets as well
//   source      van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle"
#ifndef LANELIGHT_WARP_SOLID_ANGLE_INL_H_
#define LANELIGHT_WARP_SOLID_ANGLE_INL_H_

#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Below this solid angle (steradians) lights are sampled by area instead. Points on a
/// light are rounded to about 4e-7 rad, as seen by the receiver: 1e-3 of the width of a
/// light of 3e-4 rad, straight on. The density of area samples varies over that light by
/// 1e-3, and by a third where it is seen under a cosine of 0.01 (then 3e-3 rad wide):
/// from there on rounding would take more away than the solid angle gives.
inline constexpr float kMinSolidAngle = 1e-7f;

/// A triangle as its receiver sees it: unit vectors to the corners, and what its solid
/// angle is made of. `det` is not negative.
struct SphericalTriangle {
  V3 v0, v1, v2;
  VF det, one_and_01, sum_01_2;  // 1 + v0 v1; (v0 + v1) v2

  /// to_corner: from the receiver to corner 0; edges from there to corners 1 and 2.
  LANELIGHT_INLINE SphericalTriangle(V3 to_corner, V3 e1, V3 e2) {
    const V3 p1 = to_corner + e1, p2 = to_corner + e2;
    const VF r0 = Rsqrt(Dot(to_corner, to_corner));
    const VF r1 = Rsqrt(Dot(p1, p1)), r2 = Rsqrt(Dot(p2, p2));
    v0 = Mul(to_corner, r0);
    v1 = Mul(p1, r1);
    v2 = Mul(p2, r2);
    det = hn::Abs(Dot(v0, Cross(Mul(e1, r1), Mul(e2, r2))));
    const V3 s = v0 + v1;
    one_and_01 = hn::Mul(Splat(0.5f), Dot(s, s));
    sum_01_2 = Dot(s, v2);
  }
  /// Steradians, 0 to 2 pi; NaN at a corner.
  LANELIGHT_INLINE VF SolidAngle() const {
    return hn::Mul(Splat(2.0f), Atan2(det, hn::Add(one_and_01, sum_01_2)));
  }
};

/// A rectangle in its receiver's frame: [x0, x1] x [y0, y1] at height z >= 0.
struct LocalRectangle {
  VF x0, x1, y0, y1, z;

  /// Units along the sides and their lengths; `n` is their cross product.
  LANELIGHT_INLINE LocalRectangle(V3 to_corner, V3 along_x, V3 along_y, V3 n, VF size_x,
                                  VF size_y)
      : x0(Dot(to_corner, along_x)),
        x1(hn::Add(x0, size_x)),
        y0(Dot(to_corner, along_y)),
        y1(hn::Add(y0, size_y)),
        z(hn::Abs(Dot(to_corner, n))) {}

  /// Steradians, 0 to 2 pi; NaN at a corner. size_x, size_y: lengths of the sides.
  LANELIGHT_INLINE VF SolidAngle(VF size_x, VF size_y) const {
    const V3 a = Unit(x0, y0), b = Unit(x1, y0), c = Unit(x1, y1), d = Unit(x0, y1);
    // z is height over distance in the unit vectors already.
    const VF sides = hn::Mul(hn::Mul(size_x, InverseDistance(x1, y0)),
                             hn::Mul(size_y, InverseDistance(x0, y1)));
    const VF det_a = hn::Mul(a.z, sides), det_c = hn::Mul(c.z, sides);
    const V3 s = b + d;
    const VF half = hn::Mul(Splat(0.5f), Dot(s, s));
    const VF d_a = hn::Add(half, Dot(s, a)), d_c = hn::Add(half, Dot(s, c));
    const VF imaginary = hn::MulAdd(d_a, det_c, hn::Mul(d_c, det_a));
    const VF real = hn::NegMulAdd(det_a, det_c, hn::Mul(d_a, d_c));
    // Half of 2 pi may round to either side of pi.
    return hn::Mul(Splat(2.0f), Atan2(hn::Abs(imaginary), real));
  }

  /// Direction to (x, y, z).
  LANELIGHT_INLINE V3 Unit(VF x, VF y) const {
    return Mul(V3{x, y, z}, InverseDistance(x, y));
  }

 private:
  LANELIGHT_INLINE VF InverseDistance(VF x, VF y) const {
    return Rsqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, Sqr(z))));
  }
};

// Points of the unit square with a density that is bilinear in the weights of its
// corners.
//   density     b(u) = 4 (w00 (1 - u0) (1 - u1) + w10 u0 (1 - u1) + w01 (1 - u0) u1
//               + w11 u0 u1) / (w00 + w10 + w01 + w11)
//   method      u1 from its marginal, which is linear, then u0 given u1, linear as well;
//               the root of the quadratic in the form without cancellation
//   error       below 1e-6 of the density of a point, for weights of one sign
//   source      Hart, Pharr, Muller, Lopes, McGuire and Shirley 2020, "Practical Product
//               Sampling by Fitting and Composing Warps"
struct UnitSquarePoint {
  VF u0, u1;
};

/// In [0, 1), with a density proportional to a + (b - a) x; a, b positive.
LANELIGHT_INLINE VF SampleLinear(VF u, VF a, VF b) {
  const VF a2 = Sqr(a);
  const VF root = hn::Sqrt(hn::MulAdd(u, hn::Sub(Sqr(b), a2), a2));
  const VF x = hn::Div(hn::Mul(u, hn::Add(a, b)), hn::Add(a, root));
  return hn::Min(x, Splat(1 - 0x1p-24f));
}

/// Weights of the corners (u0, u1), positive; 1e-6 to 1e6.
struct Bilinear {
  VF w00, w10, w01, w11;

  /// Samples a point for u0, u1 in [0, 1).
  LANELIGHT_INLINE UnitSquarePoint Sample(VF u0, VF u1) const {
    const VF v = SampleLinear(u1, hn::Add(w00, w10), hn::Add(w01, w11));
    return {SampleLinear(u0, Mix(v, w00, w01), Mix(v, w10, w11)), v};
  }
  /// Density over the square; its mean is 1.
  LANELIGHT_INLINE VF Pdf(UnitSquarePoint u) const {
    const VF here = Mix(u.u1, Mix(u.u0, w00, w10), Mix(u.u0, w01, w11));
    const VF sum = hn::Add(hn::Add(w00, w10), hn::Add(w01, w11));
    return hn::Div(hn::Mul(Splat(4.0f), here), sum);
  }

 private:
  static LANELIGHT_INLINE VF Mix(VF x, VF a, VF b) {
    return hn::MulAdd(x, hn::Sub(b, a), a);
  }
};

LANELIGHT_END_KERNELS

#endif
