// Uniform points of a triangle as barycentric weights: the square is folded along its
// diagonal with little distortion (Heitz 2019, "A Low-Distortion Map Between Triangle and
// Square").
#if defined(LANELIGHT_WARP_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_WARP_TRIANGLE_INL_H_
#undef LANELIGHT_WARP_TRIANGLE_INL_H_
#else
#define LANELIGHT_WARP_TRIANGLE_INL_H_
#endif

#include "kernels/warp/disk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Weights of the first two vertices (the third has the rest), uniform over the triangle:
/// density 1 / area. u in [0,1]^2. The smaller coordinate is halved and what is left of
/// the larger one stays: the half-square becomes the triangle, area divided by two.
HWY_INLINE V2 SampleTriangle(VF u0, VF u1) {
  const VF half = Splat(0.5f);
  const VF half_low = hn::Mul(hn::Min(u0, u1), half);
  const VF rest = hn::Sub(hn::Max(u0, u1), half_low);
  const MF first_low = hn::Lt(u0, u1);
  return {hn::IfThenElse(first_low, half_low, rest),
          hn::IfThenElse(first_low, rest, half_low)};
}
HWY_INLINE VF PdfTriangle(VF area) { return hn::Div(Splat(1.0f), area); }
HWY_INLINE V2 InvertTriangle(V2 b) {
  const VF low = hn::Min(b.x, b.y);
  const VF sum = hn::Add(b.x, b.y), twice = hn::Add(low, low);
  const MF first_low = hn::Lt(b.x, b.y);
  return {hn::IfThenElse(first_low, twice, sum), hn::IfThenElse(first_low, sum, twice)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
