// Directions on the whole sphere and on a cone around +z. Densities are with respect to
// solid angle.
#if defined(LANELIGHT_WARP_SPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_WARP_SPHERE_INL_H_
#undef LANELIGHT_WARP_SPHERE_INL_H_
#else
#define LANELIGHT_WARP_SPHERE_INL_H_
#endif

#include "kernels/warp/hemisphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Density 1 / (4 pi). u in [0,1)^2.
HWY_INLINE V3 SampleUniformSphere(VF u0, VF u1) {
  const VF sin2 = hn::Mul(hn::Mul(Splat(4.0f), u0), hn::Sub(Splat(1.0f), u0));
  return FromHeight(hn::NegMulAdd(Splat(2.0f), u0, Splat(1.0f)), sin2, u1);
}
HWY_INLINE VF PdfUniformSphere() { return Splat(0.25f * kInvPi); }
HWY_INLINE V2 InvertUniformSphere(V3 w) {
  return {hn::NegMulAdd(Splat(0.5f), w.z, Splat(0.5f)), TurnOf(w)};
}

/// Uniform over the cone with 1 - cos of its half angle `rise`, in (0, 2]. The rise, not
/// the cosine, is the parameter, because a narrow cone's cosine is 1 in float.
HWY_INLINE V3 SampleCone(VF rise, VF u0, VF u1) {
  const VF below = hn::Mul(u0, rise);  // 1 - z
  const VF sin2 = hn::Mul(below, hn::Sub(Splat(2.0f), below));
  return FromHeight(hn::Sub(Splat(1.0f), below), sin2, u1);
}
HWY_INLINE VF PdfCone(VF rise) { return hn::Div(Splat(0.5f * kInvPi), rise); }
/// `w` inside the cone. 1 - z comes from x and y, so that narrow cones invert well.
HWY_INLINE V2 InvertCone(VF rise, V3 w) {
  const VF sin2 = hn::MulAdd(w.x, w.x, hn::Mul(w.y, w.y));
  const VF one = Splat(1.0f);
  const VF below = hn::IfThenElse(hn::Gt(w.z, Splat(0.5f)),
                                  hn::Div(sin2, hn::Add(one, w.z)), hn::Sub(one, w.z));
  return {hn::Div(below, rise), TurnOf(w)};
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
