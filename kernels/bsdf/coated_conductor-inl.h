// Lacquered metal: a dielectric coat over a conductor, simulated by a random walk between
// the two layers (position-free walk of Guo, Hasan and Zhao 2018). Depth limit and
// absorbing medium are those of pbrt-v4's LayeredBxDF.
#ifndef LANELIGHT_BSDF_COATED_CONDUCTOR_INL_H_
#define LANELIGHT_BSDF_COATED_CONDUCTOR_INL_H_

#include "kernels/bsdf/layer-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

/// Both Eval and Sample are estimates: unbiased, with random numbers of their own beyond
/// the sample points. The density of the walk is unknown, but multiple importance
/// sampling does not need it. The weights
///     w_light = pl^2 / (pl^2 + q^2),   w_bsdf = q^2 / (pl^2 + q^2)
/// sum to 1 for every direction whatever q is, as long as q is a fixed function of (wo,
/// wi) that both techniques use; each estimator weighs f correctly by itself. So `pdf`
/// here is such a proxy q, close to the walk's density: the closer, the less noise. Only
/// directions reached by delta events alone report 0.
struct CoatedConductorBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  static constexpr bool kStochastic = true;
  static constexpr bool kHasDelta = true;
  struct Params {
    CoatLayer coat;
    MetalLayer metal;
    VF thickness;
    VI depth;
    LaneRandom random;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const MaterialTable& t = in.table;
    return {{Layer::FromAlpha(in.AlphaX(), in.AlphaY()), in.Float(t.eta)},
            {Layer::FromAlpha(in.Alpha2X(), in.Alpha2Y()), in.Color0(), in.Color1()},
            in.CoatThickness(),
            in.Int(t.coat_depth),
            in.random};
  }

  /// exp(-thickness / |cos w|): one crossing of the medium.
  LANELIGHT_LONG_BSDF_CALL static VF Crossing(const Params& p, V3 w) {
    return Exp(hn::Neg(hn::Div(p.thickness, hn::Max(hn::Abs(w.z), Splat(1e-6f)))));
  }

  /// The proxy q (see above), both directions on the upper side. It sums the coat's
  /// reflection, the metal's reflection as seen through the coat, and a tenth of a cosine
  /// lobe so that it never vanishes. Refraction widens slopes by eta; a rough coat adds
  /// its own.
  LANELIGHT_LONG_BSDF_CALL static VF Proxy(const Params& p, V3 wo, V3 wi) {
    const V3 m = Normalize(wo + wi);
    const auto widened = [&](VF metal, VF coat) HWY_ATTR {
      const VF through = hn::Mul(metal, p.coat.eta);
      return hn::Sqrt(hn::MulAdd(through, through, Sqr(coat)));
    };
    const VF zero = hn::Zero(DF());
    const VF coat_x = hn::IfThenZeroElse(p.coat.layer.smooth, p.coat.layer.ggx.ax);
    const VF coat_y = hn::IfThenZeroElse(p.coat.layer.smooth, p.coat.layer.ggx.ay);
    Layer seen = Layer::FromAlpha(widened(p.metal.layer.ggx.ax, coat_x),
                                  widened(p.metal.layer.ggx.ay, coat_y));
    const VF quarter = Splat(0.25f);
    const VF f = DielectricInterface(wo.z, p.coat.eta).reflectance;
    const VF fraction =
        hn::IfThenElse(p.coat.layer.smooth, zero, hn::Mul(Splat(0.9f), f));
    const VF from_coat = hn::Mul(quarter, p.coat.layer.Visible(wo, m));
    const VF from_metal = hn::Mul(quarter, seen.Visible(wo, m));
    const VF even = hn::Mul(Splat(0.1f * kInvPi), wi.z);
    const VF rest = hn::Sub(Splat(0.9f), fraction);
    return hn::MulAdd(fraction, from_coat, hn::MulAdd(rest, from_metal, even));
  }

  /// One estimate of f |cos wi| by a walk from wo that is connected to wi at every
  /// possible vertex: at the metal through a refraction sampled from wi, at the coat by
  /// evaluating the refraction towards wi; the power heuristic joins the two.
  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& p, V3 wo_any, V3 wi_any) {
    const V3 wo = {wo_any.x, wo_any.y, hn::Abs(wo_any.z)};
    const V3 wi = {wi_any.x, wi_any.y, hn::Abs(wi_any.z)};
    const MF same = SameSide(wo_any, wi_any);
    const V3 walk = Mul(Connections(p, wo, wi), wi.z);
    const V3 f_cos = walk + p.coat.EvalReflection(wo, wi).f_cos;
    return {IfThenElseZero(same, f_cos), hn::IfThenElseZero(same, Proxy(p, wo, wi))};
  }

  LANELIGHT_LONG_BSDF_CALL static V3 Connections(const Params& p, V3 wo, V3 wi) {
    const VF one = Splat(1.0f);
    V3 sum = Splat3(0, 0, 0);
    VF u[4];
    LaneRandom random = p.random;
    random.Next4(u);
    // Directions below the coat point down (z < 0); `w` is where the walk is heading.
    const LayerEvent in = p.coat.Sample<Outcome::kTransmit>(wo, one, u[0], u[1], true);
    const LayerEvent out = p.coat.Sample<Outcome::kTransmit>(wi, one, u[2], u[3], false);
    const VF out_medium = Crossing(p, out.wi);
    const MF found_out = CarriesAny(out.weight);
    V3 beta = in.weight, w = in.wi;
    for (int depth = 0;; depth += 2) {
      const MF active = hn::And(IsDeeper(p.depth, depth), CarriesAny(beta));
      if (hn::AllFalse(DF(), active)) break;
      beta = IfThenElseZero(active, Mul(beta, Crossing(p, w)));
      const V3 to_walk = -w, to_light = -out.wi;
      const LayerValue at = p.metal.Eval(to_walk, to_light);
      const VF weight_out =
          hn::IfThenElse(p.coat.layer.smooth, one, PowerHeuristic(out.pdf, at.pdf));
      const V3 metal =
          Mul(Mul(beta, at.f), Mul(out.weight, hn::Mul(weight_out, out_medium)));
      random.Next4(u);
      const LayerEvent up = p.metal.Sample(to_walk, u[0], u[1]);
      beta = Mul(beta, up.weight);
      const LayerValue exit = p.coat.EvalExit(-up.wi, wi);
      const VF weight_exit =
          hn::IfThenElse(p.metal.layer.smooth, one, PowerHeuristic(up.pdf, exit.pdf));
      const VF medium = Crossing(p, up.wi);
      const V3 coat = Mul(Mul(beta, exit.f), hn::Mul(weight_exit, medium));
      sum = sum + IfThenElseZero(hn::And(active, found_out), metal) +
            IfThenElseZero(hn::And(active, CarriesAny(beta)), coat);
      beta = IfThenElseZero(IsDeeper(p.depth, depth + 1), Mul(beta, medium));
      const LayerEvent down =
          p.coat.Sample<Outcome::kReflect>(-up.wi, one, u[2], u[3], true);
      beta = IfThenElseZero(CarriesAny(beta), Mul(beta, down.weight));
      w = down.wi;
    }
    return sum;
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& p, V3 wo_any,
                                                    const BsdfPoints& points) {
    const V3 wo = {wo_any.x, wo_any.y, hn::Abs(wo_any.z)};
    const LayerEvent first =
        p.coat.Sample<Outcome::kEither>(wo, points.lobe, points.u0, points.u1, true);
    V3 wi = first.wi, beta = first.weight, weight = IfThenElseZero(first.reflected, beta);
    MF walking = hn::AndNot(first.reflected, CarriesAny(beta));
    MF delta = p.coat.layer.smooth;  // so far; of a walk that ends: all its events
    const MF both_smooth = hn::And(p.coat.layer.smooth, p.metal.layer.smooth);
    V3 w = first.wi;
    // Not Eval's stream, and from its start: the number of values that Eval draws depends
    // on the other lanes of the batch.
    LaneRandom random = p.random;
    random.seed = hn::Xor(random.seed, hn::Set(DU(), 0x9e3779b9u));
    VF u[4];
    for (int depth = 0;; depth += 2) {
      walking = hn::And(walking, IsDeeper(p.depth, depth + 1));
      if (hn::AllFalse(DF(), walking)) break;
      random.Next4(u);
      beta = Mul(beta, Crossing(p, w));
      const LayerEvent up = p.metal.Sample(-w, u[0], u[1]);
      beta = Mul(Mul(beta, up.weight), Crossing(p, up.wi));
      walking = hn::And(walking, CarriesAny(beta));
      random.Next4(u);
      const LayerEvent at =
          p.coat.Sample<Outcome::kEither>(-up.wi, u[0], u[1], u[2], true);
      beta = Mul(beta, at.weight);
      const MF leaves = hn::And(walking, hn::AndNot(at.reflected, CarriesAny(beta)));
      wi = IfThenElse(leaves, at.wi, wi);
      weight = IfThenElse(leaves, beta, weight);
      delta = hn::Or(hn::AndNot(leaves, delta), hn::And(leaves, both_smooth));
      walking = hn::And(walking, hn::And(at.reflected, CarriesAny(beta)));
      w = at.wi;
    }
    const VF proxy = Proxy(p, wo, {wi.x, wi.y, hn::Abs(wi.z)});
    return {ToSideOf(wo_any, wi), weight, hn::IfThenZeroElse(delta, proxy), Splat(1.0f)};
  }
};

LANELIGHT_END_KERNELS

#endif
