// Glass: smooth and rough boundaries between two media, and thin sheets. Radiance is
// scaled by 1 / eta^2 when it is refracted; eta_scale records it for the roulette.
#ifndef LANELIGHT_BSDF_DIELECTRIC_INL_H_
#define LANELIGHT_BSDF_DIELECTRIC_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/bsdf/ggx-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Index seen from wo's side: eta from above (outside), 1 / eta from below.
LANELIGHT_INLINE VF RelativeIndex(VF eta, V3 wo) {
  return hn::IfThenElse(hn::Gt(wo.z, hn::Zero(DF())), eta, hn::Div(Splat(1.0f), eta));
}

/// Delta reflection with probability F and delta refraction otherwise, so that weights
/// are 1 and 1 / eta^2 exactly.
struct DielectricSmoothBsdf : PlainBsdf {
  static constexpr bool kSpecular = true;
  static constexpr bool kRefracts = true;
  struct Params {
    VF eta;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) { return {in.Eta()}; }
  LANELIGHT_INLINE static VF FirstLobe(const Params& m, V3 wo) {
    return DielectricInterface(hn::Abs(wo.z), RelativeIndex(m.eta, wo)).reflectance;
  }

  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints& u) {
    const VF eta = RelativeIndex(m.eta, wo), one = Splat(1.0f);
    const Interface at = DielectricInterface(hn::Abs(wo.z), eta);
    const MF reflect = hn::Lt(u.lobe, at.reflectance);
    const V3 n = {hn::Zero(DF()), hn::Zero(DF()), hn::CopySign(one, wo.z)};
    const V3 mirrored = {hn::Neg(wo.x), hn::Neg(wo.y), wo.z};
    const V3 wi = IfThenElse(reflect, mirrored, Refract(wo, n, at.bend, eta));
    const VF eta2 = Sqr(eta);
    const VF weight = hn::IfThenElse(reflect, one, hn::Div(one, eta2));
    return {wi, Grey(weight), hn::Zero(DF()), hn::IfThenElse(reflect, one, eta2)};
  }
};

/// Two parallel smooth interfaces without thickness: interreflection between them gives
/// R + T^2 R / (1 - R^2) = 2 R / (1 + R); transmission goes straight on, unscaled.
struct ThinDielectricBsdf : PlainBsdf {
  static constexpr bool kSpecular = true;
  struct Params {
    VF eta;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) { return {in.Eta()}; }

  LANELIGHT_INLINE static VF FirstLobe(const Params& m, V3 wo) {
    const VF r = DielectricInterface(hn::Abs(wo.z), m.eta).reflectance;
    return hn::Div(hn::Add(r, r), hn::Add(Splat(1.0f), r));
  }

  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints& u) {
    const MF reflect = hn::Lt(u.lobe, FirstLobe(m, wo));
    const V3 mirrored = {hn::Neg(wo.x), hn::Neg(wo.y), wo.z};
    return {IfThenElse(reflect, mirrored, -wo), Splat3(1, 1, 1), hn::Zero(DF()),
            Splat(1.0f)};
  }
};

/// Rough boundary (Walter et al. 2007): GGX normals, each a smooth interface.
///   reflection  f cos = F D G2 / (4 cos_o),      density F Dvis / (4 wo.m)
///   refraction  f cos = (1 - F) D G2 (wo.m) |wi.m| / (cos_o q^2) / eta^2,
///               density (1 - F) Dvis |wi.m| / q^2, with q = wi.m + (wo.m) / eta
/// Weights are G2 / G1, and that over eta^2. Where the index is within kNearlyMatched of
/// 1, refraction bends by less than a float resolves, so it is treated as a delta lobe:
/// sampled with density 0, and absent from Eval.
struct DielectricRoughBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  static constexpr bool kRefracts = true;
  static constexpr bool kTransmits = true;
  static constexpr float kNearlyMatched = 1e-3f;
  struct Params {
    VF eta;
    Ggx ggx;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    return {in.Eta(), Ggx::FromAlpha(in.AlphaX(), in.AlphaY())};
  }
  LANELIGHT_INLINE static MF NearlyMatched(const Params& m) {
    return hn::Lt(hn::Abs(hn::Sub(m.eta, Splat(1.0f))), Splat(kNearlyMatched));
  }
  /// Visible normals per unit of (wo.m): Dvis / (wo.m).
  LANELIGHT_INLINE static VF Visible(VF d, VF zo, VF so) {
    return hn::Div(hn::Add(d, d), hn::Add(zo, so));
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo_any, V3 wi_any) {
    const VF zero = hn::Zero(DF()), side = hn::CopySign(Splat(1.0f), wo_any.z);
    const V3 wo = Mul(wo_any, side), wi = Mul(wi_any, side);
    const VF eta = RelativeIndex(m.eta, wo_any), zi = hn::Abs(wi.z);
    const MF reflects = hn::Gt(wi.z, zero);
    V3 n = Normalize(MulAdd(wi, hn::IfThenElse(reflects, Splat(1.0f), eta), wo));
    n = Mul(n, hn::CopySign(Splat(1.0f), n.z));
    const VF co = hn::Min(Dot(wo, n), Splat(1.0f)), ci = Dot(wi, n);
    const VF f = DielectricInterface(hn::Max(co, zero), eta).reflectance;
    const VF d = m.ggx.D(n), so = m.ggx.StretchedLength(wo),
             si = m.ggx.StretchedLength(wi);
    const VF q = hn::Add(ci, hn::Div(co, eta));
    const VF jacobian =
        hn::Div(hn::Mul(hn::Sub(Splat(1.0f), f), hn::Mul(co, hn::Neg(ci))), Sqr(q));
    // Density over Visible(): F / 4 in reflection, the Jacobian of refraction otherwise.
    const VF lobe = hn::IfThenElse(reflects, hn::Mul(Splat(0.25f), f), jacobian);
    const MF refracts =
        hn::AndNot(NearlyMatched(m), hn::And(hn::Lt(wi.z, zero), hn::Lt(ci, zero)));
    const MF exists = hn::And(hn::Gt(co, zero), hn::Or(reflects, refracts));
    const VF pdf = hn::IfThenElseZero(exists, hn::Mul(lobe, Visible(d, wo.z, so)));
    const VF scale =
        hn::IfThenElse(reflects, Splat(1.0f), hn::Div(Splat(1.0f), Sqr(eta)));
    return {Grey(hn::Mul(hn::Mul(pdf, scale), MaskingRatio(wo.z, so, zi, si))), pdf};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo_any,
                                                    const BsdfPoints& u) {
    const VF zero = hn::Zero(DF()), one = Splat(1.0f), side = hn::CopySign(one, wo_any.z);
    const V3 wo = Mul(wo_any, side);
    const VF eta = RelativeIndex(m.eta, wo_any);
    const V3 n = m.ggx.SampleVisible(wo, u.u0, u.u1);
    const VF co = hn::Clamp(Dot(wo, n), zero, one);
    const Interface at = DielectricInterface(co, eta);
    const MF reflect = hn::Lt(u.lobe, at.reflectance);
    const V3 wi = IfThenElse(reflect, Reflect(wo, n, co), Refract(wo, n, at.bend, eta));
    const MF same_side = hn::Gt(wi.z, zero), below = hn::Lt(wi.z, zero);
    const MF exists = hn::Or(hn::And(reflect, same_side), hn::AndNot(reflect, below));
    const VF so = m.ggx.StretchedLength(wo), si = m.ggx.StretchedLength(wi);
    // q = wi.m + (wo.m) / eta = -bend / eta, again without a difference.
    const VF q2 = Sqr(hn::Div(at.bend, eta));
    const VF jacobian =
        hn::Div(hn::Mul(hn::Sub(one, at.reflectance), hn::Mul(co, at.cos_t)), q2);
    const VF lobe =
        hn::IfThenElse(reflect, hn::Mul(Splat(0.25f), at.reflectance), jacobian);
    const VF density = hn::Mul(lobe, Visible(m.ggx.D(n), wo.z, so));
    const MF delta = hn::AndNot(reflect, NearlyMatched(m));
    const VF eta2 = hn::IfThenElse(reflect, one, Sqr(eta));
    const VF weight = hn::Div(MaskingRatio(wo.z, so, hn::Abs(wi.z), si), eta2);
    return {Mul(wi, side), Grey(hn::IfThenElseZero(exists, weight)),
            hn::IfThenZeroElse(delta, density), eta2};
  }
};

LANELIGHT_END_KERNELS

#endif
