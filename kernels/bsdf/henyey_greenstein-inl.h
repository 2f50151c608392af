// The phase function of Henyey and Greenstein 1941, as a policy of the shading skeleton:
//   p(wo, wi) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)),  cos between -wo and wi
// normalised over the sphere, so that a sample weighs one. The normal is arbitrary.
#ifndef LANELIGHT_BSDF_HENYEY_GREENSTEIN_INL_H_
#define LANELIGHT_BSDF_HENYEY_GREENSTEIN_INL_H_

#include "kernels/bsdf/bsdf-inl.h"

LANELIGHT_BEGIN_KERNELS

struct HenyeyGreensteinBsdf : PlainBsdf {
  static constexpr bool kTransmits = true;
  static constexpr bool kPhase = true;

  struct Params {
    VF g;  // -1 < g < 1; > 0 scatters forward
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    return {in.Float(in.table.eta)};
  }

  /// The density where 1 - cos of the angle with the peak is `versine`: forward for g >
  /// 0, else back. Then 1 + g^2 - 2 g cos = (1 - |g|)^2 + 2 |g| versine, which does not
  /// cancel.
  LANELIGHT_INLINE static VF Value(VF g, VF versine) {
    const VF one = Splat(1.0f), h = hn::Abs(g);
    const VF base = hn::MulAdd(hn::Add(h, h), versine, Sqr(hn::Sub(one, h)));
    const VF top = hn::Mul(hn::Sub(one, h), hn::Add(one, h));
    return hn::Div(hn::Mul(top, Splat(0.25f * kInvPi)), hn::Mul(base, SafeSqrt(base)));
  }
  LANELIGHT_INLINE static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const MF back = hn::Lt(m.g, hn::Zero(DF()));
    const V3 apart = IfThenElse(back, wi - wo, wi + wo);  // from the peak
    const VF pdf = Value(m.g, hn::Mul(Splat(0.5f), Dot(apart, apart)));
    return {Grey(pdf), pdf};
  }
  /// Inverts the distribution of the versine. The usual 1 + g^2 - s^2 over 2 g, with
  /// s = (1 - g^2) / (1 - g + 2 g u), comes to
  ///   v = 2 (1 - u) (1 + g u) (1 - g)^2 / (1 - g + 2 g u)^2,
  /// which needs no case for g = 0. u = 1: at the peak.
  LANELIGHT_INLINE static VF SampleVersine(VF g, VF u) {
    const VF one = Splat(1.0f), h = hn::Abs(g);
    const VF below = hn::MulAdd(hn::Add(h, h), u, hn::Sub(one, h));
    const VF ratio = hn::Div(hn::Sub(one, h), below);
    const VF rest = hn::Mul(hn::Sub(one, u), hn::MulAdd(h, u, one));
    return hn::Min(hn::Mul(Splat(2.0f), hn::Mul(rest, Sqr(ratio))), Splat(2.0f));
  }
  LANELIGHT_INLINE static BsdfSample Sample(const Params& m, V3 wo, const BsdfPoints& u) {
    const VF versine = SampleVersine(m.g, u.u0);
    const VF sine = SafeSqrt(hn::Mul(versine, hn::Sub(Splat(2.0f), versine)));
    const SinCosPair turn = SinCos2Pi(u.u1);
    const MF back = hn::Lt(m.g, hn::Zero(DF()));
    const ShadingFrame frame = FrameFromNormal(IfThenElse(back, wo, -wo));
    const V3 local = {hn::Mul(sine, turn.cos), hn::Mul(sine, turn.sin),
                      hn::Sub(Splat(1.0f), versine)};
    return {frame.FromLocal(local), Splat3(1, 1, 1), Value(m.g, versine), Splat(1.0f)};
  }
};

LANELIGHT_END_KERNELS

#endif
