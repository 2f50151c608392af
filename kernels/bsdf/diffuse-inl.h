// The diffuse models of the founding paper. Each reflects on wo's side only, and sampling
// it weighs a path with exactly the albedo.
#ifndef LANELIGHT_BSDF_DIFFUSE_INL_H_
#define LANELIGHT_BSDF_DIFFUSE_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

/// A diffuse model is a density p(cos) on the hemisphere: f * cos = albedo * p, so that
/// the weight f * cos / p is the albedo.
template <class Hemisphere>
struct DiffuseModel : PlainBsdf {
  static constexpr bool kEvenSides = true;
  struct Params {
    V3 albedo;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) { return {in.Color0()}; }

  LANELIGHT_INLINE static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const VF pdf = hn::IfThenElseZero(SameSide(wo, wi), Hemisphere::Pdf(hn::Abs(wi.z)));
    return {Mul(m.albedo, pdf), pdf};
  }

  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints& u) {
    const V3 up = Hemisphere::Sample(u.u0, u.u1);
    return {ToSideOf(wo, up), m.albedo, Hemisphere::Pdf(up.z), Splat(1.0f)};
  }
};

/// Lambert: f = albedo / pi, density cos / pi. Mean cosine 2/3.
struct CosineHemisphere {
  LANELIGHT_INLINE static V3 Sample(VF u0, VF u1) {
    return SampleCosineHemisphere(u0, u1);
  }
  LANELIGHT_INLINE static VF Pdf(VF cos_theta) { return PdfCosineHemisphere(cos_theta); }
};
using DiffuseBsdf = DiffuseModel<CosineHemisphere>;

/// "Completely diffuse": scattered directions uniform, f * cos = albedo / (2 pi), so f
/// grows without bound at grazing angles. Mean cosine 1/2. Not reciprocal.
struct UniformHemisphere {
  LANELIGHT_INLINE static V3 Sample(VF u0, VF u1) {
    return SampleUniformHemisphere(u0, u1);
  }
  LANELIGHT_INLINE static VF Pdf(VF) { return PdfUniformHemisphere(); }
};
using DiffuseUniformBsdf = DiffuseModel<UniformHemisphere>;

/// Normal plus a uniform point of the unit ball: density 2 cos^3 / pi (derived in
/// kernels/warp/sphere-inl.h), f * cos = albedo * density. Mean cosine 4/5. Not
/// reciprocal.
struct InSphereHemisphere {
  LANELIGHT_INLINE static V3 Sample(VF u0, VF u1) { return SampleInSphere(u0, u1); }
  LANELIGHT_INLINE static VF Pdf(VF cos_theta) { return PdfInSphere(cos_theta); }
};
using DiffuseInSphereBsdf = DiffuseModel<InSphereHemisphere>;

LANELIGHT_END_KERNELS

#endif
