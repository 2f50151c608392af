// directions=bsdf, light, mis: scattered directions by importance sampling of the
// material.
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

LANELIGHT_BEGIN_KERNELS

/// A proposal of the next direction has two members, with the measure of solid angle:
///   Sample  a direction, its weight, and its density
///   Pdf     the density with which Sample would find wi, given that of the material
/// `u`: the points of the bounce.
struct MaterialProposal {
  static constexpr bool kIsUniform = false;
  template <class Bsdf>
  LANELIGHT_INLINE static BsdfSample Sample(const typename Bsdf::Params& material, V3 wo,
                                            const BsdfPoints& u) {
    return Bsdf::Sample(material, wo, u);
  }
  template <class Bsdf>
  LANELIGHT_INLINE static VF Pdf(V3, V3, VF material_pdf) {
    return material_pdf;
  }
};

LANELIGHT_END_KERNELS

#endif
