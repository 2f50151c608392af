// directions=bsdf, light, mis: scattered directions distributed like the material, by the
// policies' Sample: importance sampling.
//   estimator   f(wo, wi) |cos| / p(wi), p close to proportional to f |cos|
//   density     cosine for Lambert, visible normals for GGX (Heitz 2018), lobes chosen by
//               their reflectance; each kernels/bsdf/*-inl.h states its own
//   unbiased    p > 0 wherever f > 0; light of any kind that a ray can hit counts in full
//   variance    that of the arriving light alone where p ~ f cos exactly (Lambert: none
//               under even light); unbounded as lights get small
//   cost        nothing beyond the next ray; no shadow rays but to delta lights
//   source      the paper's section 3.5.2
#ifndef LANELIGHT_DIRECTIONS_MATERIAL_INL_H_
#define LANELIGHT_DIRECTIONS_MATERIAL_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "src/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// A proposal of the next direction is made for a batch of paths and their shading frame.
/// It has two members, with the measure of solid angle:
///   Sample  a direction, what it weighs, and its density
///   Pdf     the density with which Sample would find wi, given that of the material
/// `u`: the points of the bounce. kScales: eta_scale of samples has factors besides those
/// of refraction.
struct MaterialProposal {
  static constexpr bool kScales = false;
  static constexpr bool kIsUniform = false;
  LANELIGHT_INLINE MaterialProposal(const Wave&, const Frame&, const Slots&) {}
  template <class Bsdf>
  LANELIGHT_INLINE BsdfSample Sample(const typename Bsdf::Params& material, V3 wo,
                                     const BsdfPoints& u) const {
    return Bsdf::Sample(material, wo, u);
  }
  template <class Bsdf>
  LANELIGHT_INLINE VF Pdf(const typename Bsdf::Params&, V3, V3, VF material_pdf) const {
    return material_pdf;
  }
};

LANELIGHT_END_KERNELS

#endif
