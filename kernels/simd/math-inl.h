// Elementary functions on vectors of float, without branches or tables. Each states its
// range and error bound; tests/kernels/simd/math_test.cc asserts the same numbers per
// target. Polynomials are Chebyshev fits made for this file.
#ifndef LANELIGHT_SIMD_MATH_INL_H_
#define LANELIGHT_SIMD_MATH_INL_H_

#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

inline constexpr float kPi = 3.14159265358979f;
inline constexpr float kInvPi = 0.318309886183791f;

HWY_INLINE VF Sqr(VF x) { return hn::Mul(x, x); }
/// sqrt(max(x, 0)); NaN gives 0 or NaN.
HWY_INLINE VF SafeSqrt(VF x) { return hn::Sqrt(hn::Max(x, hn::Zero(DF()))); }
/// a*b + c with a scalar b.
HWY_INLINE VF MulAddScalar(VF a, float b, VF c) { return hn::MulAdd(a, Splat(b), c); }

struct SinCosPair {
  VF sin, cos;
};

/// sin and cos of x quarter turns, |x| <= 1/2 (an angle of at most 45 degrees).
/// Absolute error below 1.2e-7.
LANELIGHT_INLINE SinCosPair SinCosOctant(VF x) {
  const VF t = Sqr(x);
  VF s = MulAddScalar(t, -0.004602149213f, Splat(0.07968021765f));
  s = hn::MulAdd(s, t, Splat(-0.6459634777f));
  s = hn::MulAdd(s, t, Splat(1.570796322f));
  VF c = MulAddScalar(t, 0.0009067398984f, Splat(-0.02086152834f));
  c = hn::MulAdd(c, t, Splat(0.2536694104f));
  c = hn::MulAdd(c, t, Splat(-1.233700549f));
  return {hn::Mul(s, x), hn::MulAdd(c, t, Splat(1.0f))};
}

/// sin(2 pi u) and cos(2 pi u) for |u| < 2^20. The reduction is exact, so the absolute
/// error stays below 1.2e-7 over the whole range, and sin^2 + cos^2 = 1 within 4e-7.
LANELIGHT_INLINE SinCosPair SinCos2Pi(VF u) {
  const DF df;
  const DI di;
  const VF quarters = hn::Mul(u, Splat(4.0f));
  const VF nearest = hn::Round(quarters);
  const VI quadrant = hn::ConvertTo(di, nearest);
  const SinCosPair r = SinCosOctant(hn::Sub(quarters, nearest));
  const VI one = hn::Set(di, 1);
  // Odd quadrants exchange sin and cos; sin is negative in quadrants 2 and 3, cos in 1
  // and 2.
  const MF swap = hn::RebindMask(df, hn::Eq(hn::And(quadrant, one), one));
  const VI sin_sign = hn::ShiftLeft<30>(hn::And(quadrant, hn::Set(di, 2)));
  const VI cos_sign = hn::ShiftLeft<30>(hn::And(hn::Add(quadrant, one), hn::Set(di, 2)));
  return {hn::Xor(hn::IfThenElse(swap, r.cos, r.sin), hn::BitCast(df, sin_sign)),
          hn::Xor(hn::IfThenElse(swap, r.sin, r.cos), hn::BitCast(df, cos_sign))};
}

/// atan(x) for |x| <= 1. Absolute error below 1.5e-7.
LANELIGHT_INLINE VF AtanUnit(VF x) {
  const VF t = Sqr(x);
  VF p = MulAddScalar(t, 0.002766283502f, Splat(-0.01573124912f));
  p = hn::MulAdd(p, t, Splat(0.04213762359f));
  p = hn::MulAdd(p, t, Splat(-0.07456854826f));
  p = hn::MulAdd(p, t, Splat(0.1061837064f));
  p = hn::MulAdd(p, t, Splat(-0.1419779779f));
  p = hn::MulAdd(p, t, Splat(0.1999187203f));
  p = hn::MulAdd(p, t, Splat(-0.3333303671f));
  p = hn::MulAdd(p, t, Splat(0.9999999818f));
  return hn::Mul(p, x);
}

/// Angle of the point (x, y) in (-pi, pi], any finite arguments. Absolute error below
/// 4e-7. The origin gives 0.
LANELIGHT_INLINE VF Atan2(VF y, VF x) {
  const VF ax = hn::Abs(x), ay = hn::Abs(y);
  const VF high = hn::Max(ax, ay), low = hn::Min(ax, ay);
  const MF origin = hn::Eq(high, hn::Zero(DF()));
  VF angle = AtanUnit(hn::Div(low, hn::IfThenElse(origin, Splat(1.0f), high)));
  angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(Splat(1.57079633f), angle), angle);
  const MF left = hn::Lt(x, hn::Zero(DF()));
  angle = hn::IfThenElse(left, hn::Sub(Splat(kPi), angle), angle);
  return hn::CopySign(angle, y);
}

/// exp(x) for x <= 88. Relative error below 1.5e-7 for x >= -87, 0 below that.
LANELIGHT_INLINE VF Exp(VF x) {
  const DF df;
  const DI di;
  const VF n = hn::Round(hn::Mul(x, Splat(1.44269504f)));
  // ln 2 in two parts, the first exact in few bits, so that n * part does not round.
  const VF r =
      hn::NegMulAdd(n, Splat(-2.12194440e-4f), hn::NegMulAdd(n, Splat(0.693359375f), x));
  VF p = MulAddScalar(r, 0.001392617612f, Splat(0.008363173075f));
  p = hn::MulAdd(p, r, Splat(0.04166655466f));
  p = hn::MulAdd(p, r, Splat(0.1666657703f));
  p = hn::MulAdd(p, r, Splat(0.5f));
  p = hn::Add(hn::MulAdd(p, Sqr(r), r), Splat(1.0f));
  const VI exponent = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127)));
  return hn::IfThenElseZero(hn::Ge(x, Splat(-87.0f)),
                            hn::Mul(p, hn::BitCast(df, exponent)));
}

/// Column and row of pixel index row * width + column.
struct PixelPlace {
  VI row, column;

  // Float division is off by at most one row for images of less than 2^31 pixels, which
  // the correction undoes.
  HWY_INLINE PixelPlace(VI pixel, uint32_t image_width) {
    const DI di;
    const VI width = hn::Set(di, static_cast<int32_t>(image_width));
    row = hn::ConvertTo(di, hn::Mul(hn::ConvertTo(DF(), pixel),
                                    Splat(1.0f / static_cast<float>(image_width))));
    column = hn::Sub(pixel, hn::Mul(row, width));
    for (int step = 0; step < 2; ++step) {
      const auto low = hn::Lt(column, hn::Zero(di));
      row = hn::IfThenElse(low, hn::Sub(row, hn::Set(di, 1)), row);
      column = hn::IfThenElse(low, hn::Add(column, width), column);
      const auto high = hn::Gt(column, hn::Sub(width, hn::Set(di, 1)));
      row = hn::IfThenElse(high, hn::Add(row, hn::Set(di, 1)), row);
      column = hn::IfThenElse(high, hn::Sub(column, width), column);
    }
  }
};

LANELIGHT_END_KERNELS

#endif
