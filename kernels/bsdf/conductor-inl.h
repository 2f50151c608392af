// Metals: the exact Fresnel reflectance of a complex index per channel, on a smooth or a
// GGX surface. Both sides of the surface reflect.
#ifndef LANELIGHT_BSDF_CONDUCTOR_INL_H_
#define LANELIGHT_BSDF_CONDUCTOR_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/bsdf/ggx-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Mirror: delta direction, weight = Fresnel reflectance.
struct ConductorSmoothBsdf : PlainBsdf {
  static constexpr bool kSpecular = true;
  struct Params {
    V3 eta, k;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    return {in.Color0(), in.Color1()};
  }
  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints&) {
    return {{hn::Neg(wo.x), hn::Neg(wo.y), wo.z},
            FresnelConductor(hn::Abs(wo.z), m.eta, m.k),
            hn::Zero(DF()),
            Splat(1.0f)};
  }
};

/// Torrance-Sparrow reflection, f = D F G2 / (4 cos_o cos_i), single scattering as in
/// pbrt-v4 (Walter et al. 2007, equation 20). Sampled by visible normals:
/// density Dvis(m) / (4 wo.m), weight F G2 / G1. Light that would be sampled below the
/// surface is lost, the energy that single scattering lacks.
struct ConductorRoughBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  struct Params {
    V3 eta, k;
    Ggx ggx;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    return {in.Color0(), in.Color1(), Ggx::FromAlpha(in.AlphaX(), in.AlphaY())};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const VF zo = hn::Abs(wo.z), zi = hn::Abs(wi.z);
    const V3 n = Normalize(wo + wi);
    const VF d = m.ggx.D(n);
    const VF so = m.ggx.StretchedLength(wo), si = m.ggx.StretchedLength(wi);
    const VF shape = hn::Mul(hn::Mul(Splat(0.5f), d), HalfPairMasking(zo, so, zi, si));
    const VF pdf = hn::Div(hn::Mul(Splat(0.5f), d), hn::Add(zo, so));
    const MF reflects = SameSide(wo, wi);
    const V3 f = FresnelConductor(hn::Min(hn::Abs(Dot(wo, n)), Splat(1.0f)), m.eta, m.k);
    return {IfThenElseZero(reflects, Mul(f, shape)), hn::IfThenElseZero(reflects, pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo,
                                                    const BsdfPoints& u) {
    const V3 up = {wo.x, wo.y, hn::Abs(wo.z)};
    const V3 n = m.ggx.SampleVisible(up, u.u0, u.u1);
    const VF cosine = hn::Clamp(Dot(up, n), hn::Zero(DF()), Splat(1.0f));
    const V3 wi = Reflect(up, n, cosine);
    const MF reflects = hn::Gt(wi.z, hn::Zero(DF()));
    const VF so = m.ggx.StretchedLength(up), si = m.ggx.StretchedLength(wi);
    const VF pdf = hn::Div(hn::Mul(Splat(0.5f), m.ggx.D(n)), hn::Add(up.z, so));
    const V3 weight =
        Mul(FresnelConductor(cosine, m.eta, m.k), MaskingRatio(up.z, so, wi.z, si));
    return {ToSideOf(wo, wi), IfThenElseZero(reflects, weight), pdf, Splat(1.0f)};
  }
};

LANELIGHT_END_KERNELS

#endif
