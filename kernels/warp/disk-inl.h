// The unit disk: concentric map (Shirley and Chiu 1997). Preserves area and
// neighbourhoods, so stratified points stay stratified.
#ifndef LANELIGHT_WARP_DISK_INL_H_
#define LANELIGHT_WARP_DISK_INL_H_

#include "kernels/simd/math-inl.h"

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

/// Density of SampleDisk with respect to area: 1/pi inside the disk.
HWY_INLINE VF PdfDisk() { return Splat(kInvPi); }

/// (u0, u1) that SampleDisk maps to the point p of the disk.
HWY_INLINE V2 InvertDisk(V2 p) {
  const VF radius = hn::Sqrt(hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y)));
  const MF x_longer = hn::Gt(hn::Abs(p.x), hn::Abs(p.y));
  const VF longer = hn::CopySign(radius, hn::IfThenElse(x_longer, p.x, p.y));
  const VF top = hn::IfThenElse(x_longer, p.y, p.x);
  const VF bottom = hn::IfThenElse(x_longer, p.x, p.y);
  const VF divisor = hn::IfThenElse(hn::Eq(bottom, hn::Zero(DF())), Splat(1.0f), bottom);
  const VF shorter =
      hn::Mul(hn::Mul(longer, Splat(4.0f * kInvPi)), AtanUnit(hn::Div(top, divisor)));
  const VF half = Splat(0.5f);
  const VF a = hn::IfThenElse(x_longer, longer, shorter);
  const VF b = hn::IfThenElse(x_longer, shorter, longer);
  return {hn::MulAdd(a, half, half), hn::MulAdd(b, half, half)};
}

LANELIGHT_END_KERNELS

#endif
