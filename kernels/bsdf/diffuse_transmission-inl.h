// A thin translucent sheet: Lambertian reflection and Lambertian transmission.
#ifndef LANELIGHT_BSDF_DIFFUSE_TRANSMISSION_INL_H_
#define LANELIGHT_BSDF_DIFFUSE_TRANSMISSION_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

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
    // Both black: any probability will do, the weight is 0.
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
