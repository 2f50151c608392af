// Coats with a medium that scatters between interface and base, by a random walk (Guo,
// Hasan and Zhao 2018; pbrt-v4's LayeredBxDF). The medium has unit extinction: a ray at
// cosine c scatters after a depth that is exponentially distributed with mean c, with the
// Henyey-Greenstein phase function, and keeps its albedo.
//
// An event is a scattering, a reflection at the base, one at the interface, or the exit
// through it; a walk has at most coat_depth of them after its entry, as pbrt's samples.
//
// Eval and Sample are estimates and the density is a proxy, as in coated_conductor-inl.h.
// If interface and base are both smooth, Eval finds only light that a scattering sends
// straight out. Walks that leave straight from the base report density 0, so that each is
// found by exactly one technique or by both with weights. (As in pbrt, such walks miss
// lights that no ray can hit.)
#ifndef LANELIGHT_BSDF_COATED_MEDIUM_INL_H_
#define LANELIGHT_BSDF_COATED_MEDIUM_INL_H_

#include "hwy/contrib/math/math-inl.h"
#include "kernels/bsdf/coat_bases-inl.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Base>
struct CoatedMediumBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  static constexpr bool kStochastic = true;
  static constexpr bool kHasDelta = true;
  struct Params {
    CoatLayer coat;
    Base base;
    VF thickness;
    HenyeyGreensteinBsdf::Params phase;
    V3 albedo;
    VI depth;
    LaneRandom random;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const MaterialTable& t = in.table;
    return {{Layer::FromAlpha(in.AlphaX(), in.AlphaY()), in.Float(t.eta)},
            Base::Load(in),
            in.CoatThickness(),
            {in.CoatG()},
            in.CoatAlbedo(),
            in.Int(t.coat_depth),
            in.random};
  }

  /// A walk between two events: its height above the base, the direction in which it
  /// goes, and its throughput.
  struct Walk {
    VF height;
    V3 w, beta;
  };
  /// The kind of the next event; at most one of the three.
  struct Next {
    MF scatters, at_base, at_coat;
  };
  /// Returns the fraction of light that survives a path of this height along w.
  LANELIGHT_INLINE static VF Passes(VF height, V3 w) {
    return Exp(hn::Neg(hn::Div(height, hn::Max(hn::Abs(w.z), Splat(1e-6f)))));
  }

  /// Moves the walk to its next event. u in [0, 1).
  static HWY_NOINLINE Next Advance(const Params& p, VF u, Walk& walk) {
    const VF zero = hn::Zero(DF());
    const VF path = hn::Neg(hn::Log(DF(), hn::Sub(Splat(1.0f), u)));
    const VF go = hn::Mul(path, hn::Abs(walk.w.z));
    const MF up = hn::Gt(walk.w.z, zero), down = hn::Lt(walk.w.z, zero);
    const VF room = hn::IfThenElse(up, hn::Sub(p.thickness, walk.height), walk.height);
    const MF scatters = hn::And(hn::Lt(go, room), hn::Or(up, down));
    const VF end = hn::IfThenElseZero(up, p.thickness);
    const VF moved = hn::Add(walk.height, hn::CopySign(go, walk.w.z));
    walk.height = hn::IfThenElse(scatters, moved, end);
    return {scatters, hn::AndNot(scatters, down), hn::AndNot(scatters, up)};
  }

  /// Scattering in the medium or at the base: the next direction, with the density.
  static HWY_NOINLINE VF Scatter(const Params& p, const Next& next, VF u0, VF u1,
                                 Walk& walk) {
    const V3 back = -walk.w;
    const BsdfSample around =
        HenyeyGreensteinBsdf::Sample(p.phase, back, {hn::Zero(DF()), u0, u1});
    const LayerEvent above = p.base.Sample(back, u0, u1);
    walk.w = IfThenElse(next.scatters, around.wi, above.wi);
    walk.beta = Mul(walk.beta, IfThenElse(next.scatters, p.albedo,
                                          IfThenElseZero(next.at_base, above.weight)));
    return hn::IfThenElse(next.scatters, around.pdf, above.pdf);
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& p, V3 wo_any, V3 wi_any) {
    const V3 wo = {wo_any.x, wo_any.y, hn::Abs(wo_any.z)};
    const V3 wi = {wi_any.x, wi_any.y, hn::Abs(wi_any.z)};
    const MF same = SameSide(wo_any, wi_any);
    const V3 walk = Mul(Connections(p, wo, wi), wi.z);
    const V3 f_cos = walk + p.coat.EvalReflection(wo, wi).f_cos;
    const VF proxy = p.base.Proxy(p.coat, wo, wi);
    return {IfThenElseZero(same, f_cos), hn::IfThenElseZero(same, proxy)};
  }

  /// Returns the light that a refraction from wi sends down to the event, scattered there
  /// towards the walk. `found` is that refraction, as importance.
  static HWY_NOINLINE V3 FromLight(const Params& p, const Next& next,
                                   const LayerEvent& found, const Walk& walk) {
    const VF one = Splat(1.0f);
    const V3 back = -walk.w, to_light = -found.wi;
    const VF phase = HenyeyGreensteinBsdf::Eval(p.phase, back, to_light).pdf;
    const LayerValue base = p.base.Eval(back, to_light);
    // The weight of the refraction holds a cosine, which in a medium has no place.
    const VF cosine = hn::Max(to_light.z, Splat(1e-6f));
    const V3 f = IfThenElse(next.scatters, Mul(p.albedo, hn::Div(phase, cosine)), base.f);
    const VF pdf = hn::IfThenElse(next.scatters, phase, base.pdf);
    const VF weight =
        hn::IfThenElse(p.coat.layer.smooth, one, PowerHeuristic(found.pdf, pdf));
    const VF passes = Passes(hn::Sub(p.thickness, walk.height), to_light);
    const MF meet =
        hn::And(CarriesAny(found.weight), hn::Or(next.scatters, next.at_base));
    const V3 carried = Mul(Mul(walk.beta, f), Mul(found.weight, hn::Mul(weight, passes)));
    return IfThenElseZero(meet, carried);
  }

  /// Returns the light of a walk that leaves along its direction, sampled with `pdf`
  /// (`mirror`: a mirror), through the interface towards wi.
  static HWY_NOINLINE V3 ThroughCoat(const Params& p, MF mirror, VF pdf, V3 wi,
                                     const Walk& walk) {
    const LayerValue exit = p.coat.EvalExit(-walk.w, wi);
    const VF weight = hn::IfThenElse(mirror, Splat(1.0f), PowerHeuristic(pdf, exit.pdf));
    const VF passes = Passes(hn::Sub(p.thickness, walk.height), walk.w);
    const MF goes = hn::And(CarriesAny(walk.beta), hn::Gt(walk.w.z, hn::Zero(DF())));
    return IfThenElseZero(goes, Mul(Mul(walk.beta, exit.f), hn::Mul(weight, passes)));
  }

  LANELIGHT_LONG_BSDF_CALL static V3 Connections(const Params& p, V3 wo, V3 wi) {
    const VF one = Splat(1.0f);
    V3 sum = Splat3(0, 0, 0);
    VF u[4], v[4];
    LaneRandom random = p.random;
    random.Next4(u);
    const LayerEvent in =
        p.coat.template Sample<Outcome::kTransmit>(wo, one, u[0], u[1], true);
    const LayerEvent found =
        p.coat.template Sample<Outcome::kTransmit>(wi, one, u[2], u[3], false);
    Walk walk = {p.thickness, in.wi, in.weight};
    for (int depth = 0;; ++depth) {  // one event, and the exit after it
      const MF active = hn::And(IsDeeper(p.depth, depth + 1), CarriesAny(walk.beta));
      if (hn::AllFalse(DF(), active)) break;
      walk.beta = IfThenElseZero(active, walk.beta);
      random.Next4(u);
      random.Next4(v);
      const Next next = Advance(p, u[0], walk);
      sum = sum + FromLight(p, next, found, walk);
      const LayerEvent down =
          p.coat.template Sample<Outcome::kReflect>(-walk.w, one, v[0], v[1], true);
      const V3 reflected = IfThenElseZero(next.at_coat, Mul(walk.beta, down.weight));
      const VF pdf = Scatter(p, next, u[1], u[2], walk);
      const MF mirror = hn::AndNot(next.scatters, p.base.Smooth());
      sum = sum + ThroughCoat(p, mirror, pdf, wi, walk);
      walk.w = IfThenElse(next.at_coat, down.wi, walk.w);
      walk.beta = IfThenElse(next.at_coat, reflected, walk.beta);
    }
    return sum;
  }

  /// The direction and weight with which a walk has left.
  struct Exit {
    V3 wi, weight;
    MF delta;
  };
  LANELIGHT_LONG_BSDF_CALL static Exit FollowWalk(const Params& p,
                                                  const LayerEvent& first) {
    Exit exit = {first.wi, IfThenElseZero(first.reflected, first.weight),
                 p.coat.layer.smooth};
    MF walking = hn::AndNot(first.reflected, CarriesAny(first.weight));
    MF from_mirror = walking;  // the last event was a reflection at a smooth base
    Walk walk = {p.thickness, first.wi, first.weight};
    LaneRandom random = p.random;  // another stream than Eval's
    random.seed = hn::Xor(random.seed, hn::Set(DU(), 0x9e3779b9u));
    VF u[4], v[4];
    for (int depth = 0;; ++depth) {
      walking =
          hn::And(walking, hn::And(IsDeeper(p.depth, depth), CarriesAny(walk.beta)));
      if (hn::AllFalse(DF(), walking)) break;
      random.Next4(u);
      random.Next4(v);
      const Next next = Advance(p, u[0], walk);
      const LayerEvent at =
          p.coat.template Sample<Outcome::kEither>(-walk.w, v[0], v[1], v[2], true);
      const V3 after = IfThenElseZero(next.at_coat, Mul(walk.beta, at.weight));
      const MF leaves = hn::And(hn::And(walking, CarriesAny(after)),
                                hn::AndNot(at.reflected, next.at_coat));
      exit.wi = IfThenElse(leaves, at.wi, exit.wi);
      exit.weight = IfThenElse(leaves, after, exit.weight);
      const MF delta = hn::And(p.coat.layer.smooth, from_mirror);
      exit.delta = hn::Or(hn::AndNot(leaves, exit.delta), hn::And(leaves, delta));
      walking = hn::AndNot(leaves, walking);
      Scatter(p, next, u[1], u[2], walk);
      walk.w = IfThenElse(next.at_coat, at.wi, walk.w);
      walk.beta = IfThenElse(next.at_coat, after, walk.beta);
      from_mirror = hn::And(next.at_base, p.base.Smooth());
    }
    return exit;
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& p, V3 wo_any,
                                                    const BsdfPoints& points) {
    const V3 wo = {wo_any.x, wo_any.y, hn::Abs(wo_any.z)};
    const LayerEvent first = p.coat.template Sample<Outcome::kEither>(
        wo, points.lobe, points.u0, points.u1, true);
    const Exit exit = FollowWalk(p, first);
    const VF proxy = p.base.Proxy(p.coat, wo, {exit.wi.x, exit.wi.y, hn::Abs(exit.wi.z)});
    return {ToSideOf(wo_any, exit.wi), exit.weight, hn::IfThenZeroElse(exit.delta, proxy),
            Splat(1.0f)};
  }
};

struct CoatedDiffuseMediumBsdf : CoatedMediumBsdf<DiffuseLayer> {};
struct CoatedConductorMediumBsdf : CoatedMediumBsdf<MetalBelowMedium> {};

LANELIGHT_END_KERNELS

#endif
