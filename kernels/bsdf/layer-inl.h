// The two layers of a coated metal, each sampled and evaluated on its own: a dielectric
// interface and a metal, smooth or GGX per lane. Directions may lie on either side of the
// interface; the metal is met from above.
#ifndef LANELIGHT_BSDF_LAYER_INL_H_
#define LANELIGHT_BSDF_LAYER_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/bsdf/ggx-inl.h"

LANELIGHT_BEGIN_KERNELS

/// pbrt-v4 treats a surface below this roughness as smooth.
inline constexpr float kSmoothAlpha = 1e-3f;

/// One event at a layer: direction, weight, density (solid angle; unused if smooth).
struct LayerEvent {
  V3 wi, weight;
  VF pdf;
  MF reflected;
};

/// f (without a cosine) and the density of sampling the pair.
struct LayerValue {
  V3 f;
  VF pdf;
};

LANELIGHT_INLINE MF CarriesAny(V3 beta) {
  return hn::Gt(MaxComponent(beta), hn::Zero(DF()));
}
LANELIGHT_INLINE MF IsDeeper(VI limit, int depth) {
  return hn::RebindMask(DF(), hn::Gt(limit, hn::Set(DI(), depth)));
}
/// pa^2 / (pa^2 + pb^2).
LANELIGHT_INLINE VF PowerHeuristic(VF pa, VF pb) {
  const VF ratio = hn::Div(pb, hn::Max(pa, Splat(1e-30f)));
  return hn::Div(Splat(1.0f), hn::MulAdd(ratio, ratio, Splat(1.0f)));
}

struct Layer {
  Ggx ggx;
  MF smooth;

  LANELIGHT_INLINE static Layer FromAlpha(VF ax, VF ay) {
    return {Ggx::FromAlpha(ax, ay), hn::Lt(hn::Max(ax, ay), Splat(kSmoothAlpha))};
  }
  LANELIGHT_INLINE V3 SampleNormal(V3 wo, VF u0, VF u1) const {
    return IfThenElse(smooth, Splat3(0, 0, 1), ggx.SampleVisible(wo, u0, u1));
  }
  /// G2 / G1 of the pair, 1 where smooth.
  LANELIGHT_INLINE VF Ratio(V3 wo, V3 wi) const {
    const VF rough = MaskingRatio(wo.z, ggx.StretchedLength(wo), hn::Abs(wi.z),
                                  ggx.StretchedLength(wi));
    return hn::IfThenElse(smooth, Splat(1.0f), rough);
  }
  /// Dvis / (wo.m).
  LANELIGHT_INLINE VF Visible(V3 wo, V3 m) const {
    const VF d = ggx.D(m);
    return hn::Div(hn::Add(d, d), hn::Add(wo.z, ggx.StretchedLength(wo)));
  }
};

/// The outcomes that CoatLayer::Sample may choose.
enum class Outcome { kReflect, kTransmit, kEither };

struct CoatLayer {
  Layer layer;
  VF eta;  // of the inside relative to the outside

  LANELIGHT_INLINE VF IndexFrom(V3 w) const {
    return hn::IfThenElse(hn::Gt(w.z, hn::Zero(DF())), eta, hn::Div(Splat(1.0f), eta));
  }

  /// Samples the interface from wo, on either side. `radiance`: refraction scales by
  /// 1 / eta^2, because radiance flows towards wo; importance is not scaled. A weight of
  /// 0 means no outcome.
  template <Outcome kOutcome>
  LANELIGHT_LONG_BSDF_CALL LayerEvent Sample(V3 wo_any, VF u_lobe, VF u0, VF u1,
                                             bool radiance) const {
    const VF zero = hn::Zero(DF()), one = Splat(1.0f), side = hn::CopySign(one, wo_any.z);
    const V3 wo = Mul(wo_any, side);
    const VF index = IndexFrom(wo_any);
    const V3 m = layer.SampleNormal(wo, u0, u1);
    const VF co = hn::Clamp(Dot(wo, m), zero, one);
    const Interface at = DielectricInterface(co, index);
    const VF pass = hn::Sub(one, at.reflectance);
    MF reflect = hn::Lt(u_lobe, at.reflectance);
    if constexpr (kOutcome == Outcome::kReflect) reflect = hn::Eq(zero, zero);
    if constexpr (kOutcome == Outcome::kTransmit) reflect = hn::Ne(zero, zero);
    const V3 wi = IfThenElse(reflect, Reflect(wo, m, co), Refract(wo, m, at.bend, index));
    const MF right_side = hn::Or(hn::And(reflect, hn::Gt(wi.z, zero)),
                                 hn::AndNot(reflect, hn::Lt(wi.z, zero)));
    VF weight = layer.Ratio(wo, wi);
    // Probability of the outcome, or its energy where there was no choice.
    const VF fraction = hn::IfThenElse(reflect, at.reflectance, pass);
    VF density = hn::Mul(Density(at, co, index, reflect), layer.Visible(wo, m));
    if constexpr (kOutcome == Outcome::kEither) {
      density = hn::Mul(density, fraction);
    } else {
      weight = hn::Mul(weight, fraction);
    }
    if (radiance) {
      weight = hn::IfThenElse(reflect, weight, hn::Div(weight, Sqr(index)));
    }
    return {Mul(wi, side), Grey(hn::IfThenElseZero(right_side, weight)), density,
            reflect};
  }

  /// Refraction from inside direction w (w.z < 0 here: the side of incidence of the walk)
  /// out to wi, as radiance: f, and the density with which Sample<kTransmit> from wi
  /// would find w. Zero where smooth.
  LANELIGHT_LONG_BSDF_CALL LayerValue EvalExit(V3 w, V3 wi) const {
    const VF zero = hn::Zero(DF());
    // By adjointness f(w, wi) of radiance is f(wi, w) of importance: evaluated from wi,
    // without the 1 / eta^2.
    V3 m = Normalize(MulAdd(w, eta, wi));
    m = Mul(m, hn::CopySign(Splat(1.0f), m.z));
    const VF co = hn::Min(Dot(wi, m), Splat(1.0f)), ci = Dot(w, m);
    const Interface at = DielectricInterface(hn::Max(co, zero), eta);
    const VF shape =
        hn::Mul(Density(at, co, eta, hn::Ne(zero, zero)), layer.Visible(wi, m));
    const VF zw = hn::Abs(w.z);
    // f |cos w| = (1 - F) density G2 / G1.
    const VF ratio = hn::Div(layer.Ratio(wi, w), zw);
    const MF exists = hn::AndNot(
        layer.smooth,
        hn::And(hn::Gt(co, zero), hn::And(hn::Lt(ci, zero), hn::Lt(w.z, zero))));
    const VF f = hn::Mul(hn::Mul(hn::Sub(Splat(1.0f), at.reflectance), shape), ratio);
    return {Grey(hn::IfThenElseZero(exists, f)), hn::IfThenElseZero(exists, shape)};
  }

  /// Reflection of the interface itself, from outside: f |cos wi|, and its density among
  /// all directions (reflection chosen with probability F). Zero where smooth.
  LANELIGHT_INLINE BsdfValue EvalReflection(V3 wo, V3 wi) const {
    const V3 m = Normalize(wo + wi);
    const VF co = hn::Clamp(Dot(wo, m), hn::Zero(DF()), Splat(1.0f));
    const VF f = DielectricInterface(co, eta).reflectance;
    const VF pdf = hn::Mul(hn::Mul(Splat(0.25f), f), layer.Visible(wo, m));
    const VF f_cos = hn::Mul(pdf, layer.Ratio(wo, wi));
    return {Grey(hn::IfThenZeroElse(layer.smooth, f_cos)),
            hn::IfThenZeroElse(layer.smooth, pdf)};
  }

 private:
  /// Density over Visible() given the outcome: 1/4, or (wo.m) |wi.m| / q^2.
  LANELIGHT_INLINE static VF Density(const Interface& at, VF co, VF index, MF reflect) {
    const VF q2 = hn::Max(Sqr(hn::Div(at.bend, index)), Splat(1e-30f));
    const VF refract = hn::Div(hn::Mul(co, at.cos_t), q2);
    return hn::IfThenElse(reflect, Splat(0.25f), refract);
  }
};

struct MetalLayer {
  Layer layer;
  V3 eta, k;

  /// wo.z > 0.
  LANELIGHT_LONG_BSDF_CALL LayerEvent Sample(V3 wo, VF u0, VF u1) const {
    const V3 m = layer.SampleNormal(wo, u0, u1);
    const VF co = hn::Clamp(Dot(wo, m), hn::Zero(DF()), Splat(1.0f));
    const V3 wi = Reflect(wo, m, co);
    const MF exists = hn::Gt(wi.z, hn::Zero(DF()));
    const V3 weight = Mul(FresnelConductor(co, eta, k), layer.Ratio(wo, wi));
    return {wi, IfThenElseZero(exists, weight),
            hn::Mul(Splat(0.25f), layer.Visible(wo, m)), exists};
  }

  /// f (without cosine), and the density of Sample. Zero where smooth. wo.z, wi.z > 0.
  LANELIGHT_LONG_BSDF_CALL LayerValue Eval(V3 wo, V3 wi) const {
    const V3 m = Normalize(wo + wi);
    const VF co = hn::Clamp(Dot(wo, m), hn::Zero(DF()), Splat(1.0f));
    const VF pdf = hn::Mul(Splat(0.25f), layer.Visible(wo, m));
    const VF shape = hn::IfThenZeroElse(layer.smooth, pdf);
    const VF f = hn::Div(hn::Mul(shape, layer.Ratio(wo, wi)), wi.z);
    return {Mul(FresnelConductor(co, eta, k), f), shape};
  }
};

LANELIGHT_END_KERNELS

#endif
