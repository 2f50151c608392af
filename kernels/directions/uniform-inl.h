// directions=uniform: scattered directions uniform over the hemisphere of wo, over the
// whole sphere for materials that transmit (the paper's section 3.5.1).
//   estimator   f(wo, wi) |cos| / p with p = 1 / (2 pi), or 1 / (4 pi)
//   unbiased    always: p > 0 wherever f > 0. Perfectly specular lobes, which no density
//               finds, are followed as the material says; where a material has both, a
//               fair coin decides which of the two is estimated, with weight 2
//   variance    that of f cos over the hemisphere: large for anything glossy; 1/3 of the
//               squared mean for Lambert under even light, where importance sampling has
//               none
//   cost        one evaluation of the BSDF more than importance sampling
//   source      Maughan, "Path Tracing Renderer Using Monte Carlo Methods", 3.5.1
#ifndef LANELIGHT_DIRECTIONS_UNIFORM_INL_H_
#define LANELIGHT_DIRECTIONS_UNIFORM_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Uniform over the hemisphere of wo, or over the sphere; the density is kept apart from
/// 0 at the horizon, as wi.z must not be 0.
template <class Bsdf>
LANELIGHT_INLINE BsdfSample
EvaluateUniformDirection(const typename Bsdf::Params& material, V3 wo, VF u0, VF u1) {
  VF height = u0, flip = Splat(1.0f), pdf = PdfUniformHemisphere();
  if constexpr (Bsdf::kTransmits) {
    const MF below = hn::Ge(u0, Splat(0.5f));
    flip = hn::IfThenElse(below, Splat(-1.0f), flip);
    height = hn::Mul(Splat(2.0f), hn::IfThenElse(below, hn::Sub(u0, Splat(0.5f)), u0));
    pdf = hn::Mul(pdf, Splat(0.5f));
  }
  const V3 up = SampleUniformHemisphere(height, u1);
  const V3 side = ToSideOf(wo, up);
  const V3 wi = {side.x, side.y, hn::Mul(side.z, flip)};
  const BsdfValue value = Bsdf::Eval(material, wo, wi);
  return {wi, Mul(value.f_cos, hn::Div(Splat(1.0f), pdf)), pdf, Splat(1.0f)};
}

/// A proposal as in material-inl.h.
struct UniformProposal {
  static constexpr bool kIsUniform = true;
  template <class Bsdf>
  LANELIGHT_INLINE static BsdfSample Sample(const typename Bsdf::Params& material, V3 wo,
                                            const BsdfPoints& u) {
    if constexpr (!Bsdf::kHasDelta) {
      return EvaluateUniformDirection<Bsdf>(material, wo, u.u0, u.u1);
    } else {
      const VF two = Splat(2.0f);
      const MF delta = hn::Lt(u.lobe, Splat(0.5f));
      const VF lobe =
          hn::Mul(two, hn::IfThenElse(delta, u.lobe, hn::Sub(u.lobe, Splat(0.5f))));
      const BsdfSample lobes = Bsdf::Sample(material, wo, {lobe, u.u0, u.u1});
      const BsdfSample even = EvaluateUniformDirection<Bsdf>(material, wo, u.u0, u.u1);
      const V3 specular = IfThenElseZero(hn::Eq(lobes.pdf, hn::Zero(DF())), lobes.weight);
      return {IfThenElse(delta, lobes.wi, even.wi),
              Mul(IfThenElse(delta, specular, even.weight), two),
              hn::IfThenZeroElse(delta, even.pdf), Splat(1.0f)};
    }
  }
  template <class Bsdf>
  LANELIGHT_INLINE static VF Pdf(V3 wo, V3 wi, VF) {
    const VF pdf = PdfUniformHemisphere();
    if constexpr (Bsdf::kTransmits) return hn::Mul(pdf, Splat(0.5f));
    return hn::IfThenElseZero(SameSide(wo, wi), pdf);
  }
};

LANELIGHT_END_KERNELS

#endif
