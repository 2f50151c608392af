// Diffuse materials. The three models of the founding paper reflect on wo's side only,
// and sampling them weighs a path with exactly the albedo.
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

/// f = reflectance / pi on wo's side and transmittance / pi on the other. A side is
/// chosen with probability proportional to its largest component; density = that
/// probability times cos / pi.
struct DiffuseTransmissionBsdf : PlainBsdf {
  static constexpr bool kEvenSides = true;
  static constexpr bool kTransmits = true;
  struct Params {
    V3 reflectance, transmittance;
    VF reflect;  // probability of reflection
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const V3 r = in.Color0(), t = in.Color1();
    const VF pr = MaxComponent(r), sum = hn::Add(pr, MaxComponent(t));
    return {r, t, hn::Div(pr, hn::Max(sum, Splat(1e-30f)))};
  }

  LANELIGHT_INLINE static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const MF same = SameSide(wo, wi);
    const VF lambert = PdfCosineHemisphere(hn::Abs(wi.z));
    const VF choice = hn::IfThenElse(same, m.reflect, hn::Sub(Splat(1.0f), m.reflect));
    return {Mul(IfThenElse(same, m.reflectance, m.transmittance), lambert),
            hn::Mul(choice, lambert)};
  }

  LANELIGHT_INLINE static VF FirstLobe(const Params& m, V3) { return m.reflect; }

  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints& u) {
    const MF reflect = hn::Lt(u.lobe, m.reflect);
    const V3 up = SampleCosineHemisphere(u.u0, u.u1);
    const VF choice = hn::IfThenElse(reflect, m.reflect, hn::Sub(Splat(1.0f), m.reflect));
    const V3 albedo = IfThenElse(reflect, m.reflectance, m.transmittance);
    const VF side = hn::IfThenElse(reflect, wo.z, hn::Neg(wo.z));
    const VF inverse = hn::Div(Splat(1.0f), hn::Max(choice, Splat(1e-30f)));
    return {{up.x, up.y, hn::CopySign(up.z, side)},
            Mul(albedo, inverse),
            hn::Mul(choice, PdfCosineHemisphere(up.z)),
            Splat(1.0f)};
  }
};

LANELIGHT_END_KERNELS

#endif
