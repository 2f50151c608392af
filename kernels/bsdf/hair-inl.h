// Hair as rough dielectric cylinders with tilted scales (Chiang, Bitterli, Tappan and
// Burley 2016, "A Practical and Controllable Hair and Fur Model for Production Path
// Tracing", after Marschner et al. 2003 and d'Eon et al. 2011).
#ifndef LANELIGHT_BSDF_HAIR_INL_H_
#define LANELIGHT_BSDF_HAIR_INL_H_

#include "hwy/contrib/math/math-inl.h"
#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/bsdf/fresnel-inl.h"

LANELIGHT_BEGIN_KERNELS

inline constexpr float kTwoPi = 2 * kPi;

/// exp(-x) I0(x), the modified Bessel function of order 0, x >= 0. Relative error below
/// 1e-6 (Abramowitz and Stegun 1964, 9.8.1 and 9.8.2).
LANELIGHT_INLINE VF ScaledBesselI0(VF x) {
  const auto horner = [](VF t, const auto& c) HWY_ATTR {
    VF sum = Splat(c[0]);
    for (std::size_t i = 1; i < std::size(c); ++i) sum = hn::MulAdd(sum, t, Splat(c[i]));
    return sum;
  };
  constexpr float kSmall[] = {0.0045813f, 0.0360768f, 0.2659732f, 1.2067492f,
                              3.0899424f, 3.5156229f, 1.0f};
  constexpr float kLarge[] = {0.00392377f,  -0.01647633f, 0.02635537f,
                              -0.02057706f, 0.00916281f,  -0.00157565f,
                              0.00225319f,  0.01328592f,  0.39894228f};
  const VF edge = Splat(3.75f);
  const VF small = hn::Mul(horner(Sqr(hn::Div(x, edge)), kSmall), Exp(hn::Neg(x)));
  const VF above = hn::Max(x, edge);
  const VF large = hn::Mul(horner(hn::Div(edge, above), kLarge), Rsqrt(above));
  return hn::IfThenElse(hn::Lt(x, edge), small, large);
}

/// Sine and cosine of an angle from the plane across the fibre.
struct Incline {
  VF sin, cos;
};
LANELIGHT_INLINE Incline InclineOf(VF sin) {
  return {sin, SafeSqrt(hn::Mul(hn::Sub(Splat(1.0f), sin), hn::Add(Splat(1.0f), sin)))};
}

/// Spread along the fibre: density of the incline i, cos i included, about the mirror
/// direction of o. M = exp(-sin i sin o / v) I0(cos i cos o / v) / (2 v sinh(1 / v)) is
/// written with exponents that are never positive: of 1 - cos(i + o), half the squared
/// distance of two unit vectors.
LANELIGHT_INLINE VF AlongFibre(const Incline& i, const Incline& o, VF v) {
  const VF inverse = hn::Div(Splat(1.0f), v);
  const VF apart = hn::Mul(
      Splat(0.5f), hn::Add(Sqr(hn::Sub(i.cos, o.cos)), Sqr(hn::Add(i.sin, o.sin))));
  const VF bessel = ScaledBesselI0(hn::Mul(hn::Mul(i.cos, o.cos), inverse));
  const VF norm = hn::Mul(v, hn::Sub(Splat(1.0f), Exp(hn::Mul(Splat(-2.0f), inverse))));
  return hn::Div(hn::Mul(bessel, Exp(hn::Neg(hn::Mul(apart, inverse)))), norm);
}

/// Spread around the fibre: a logistic distribution of the angle, cut to a whole turn.
struct Around {
  VF scale, tail;  // tail: of the distribution beyond half a turn

  LANELIGHT_INLINE explicit Around(VF s) : scale(s), tail(Exp(hn::Div(Splat(-kPi), s))) {
    tail = hn::Div(tail, hn::Add(Splat(1.0f), tail));
  }
  LANELIGHT_INLINE VF Within() const {
    return hn::NegMulAdd(Splat(2.0f), tail, Splat(1.0f));
  }
  /// Returns the density at an angle, modulo a whole turn.
  LANELIGHT_INLINE VF Pdf(VF angle) const {
    const VF turns = hn::Mul(angle, Splat(1 / kTwoPi));
    const VF x = hn::Mul(hn::Sub(turns, hn::Round(turns)), Splat(kTwoPi));
    const VF e = Exp(hn::Neg(hn::Div(hn::Abs(x), scale)));
    const VF bell = hn::Div(e, Sqr(hn::Add(Splat(1.0f), e)));
    return hn::Div(bell, hn::Mul(scale, Within()));
  }
  LANELIGHT_INLINE VF Sample(VF u) const {
    const VF below = hn::MulAdd(u, Within(), tail);
    const VF above = hn::MulAdd(hn::Sub(Splat(1.0f), u), Within(), tail);
    const VF x = hn::Mul(scale, hn::Log(DF(), hn::Div(below, above)));
    return hn::Clamp(x, Splat(-kPi), Splat(kPi));
  }
};

/// The fibre lies along x and is met where the sine of the angle to its normal is h, on
/// the side of +y as seen along the ray. With wi at (theta_i, phi) from it,
///   f cos = sum_p M_p(theta_i, theta_o) A_p(h) N_p(phi)
/// over reflection (p = 0), transmission (1), one internal reflection (2) and more, which
/// leave in all directions around (3). Density: the same with the share of A_p instead.
struct HairBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  static constexpr bool kTransmits = true;
  static constexpr bool kFibre = true;
  static constexpr int kLobes = 4;

  struct Params {
    VF h, eta, variance, tilt;
    Around around;
    V3 absorption;
  };

  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const VF m = in.AlphaX(), n = in.AlphaY();
    const VF h =
        in.path.uv_v == nullptr
            ? hn::Zero(DF())
            : hn::MulSub(Splat(2.0f), Gather(in.path.uv_v, in.slot), Splat(1.0f));
    return {
        .h = hn::Clamp(h, Splat(-1.0f), Splat(1.0f)),
        .eta = in.Float(in.table.eta),
        .variance = Sqr(hn::MulAdd(Splat(3.7f), Power(m, 20),
                                   hn::Mul(m, MulAddScalar(m, 0.812f, Splat(0.726f))))),
        .tilt = in.Alpha2X(),
        .around = Around(
            hn::Mul(Splat(0.626657069f),
                    hn::MulAdd(Splat(5.372f), Power(n, 22),
                               hn::Mul(n, MulAddScalar(n, 1.194f, Splat(0.265f)))))),
        .absorption = AbsorptionOf(in.Color0(), n)};
  }

  /// Returns the absorption with which dense hair of this roughness has that reflectance.
  LANELIGHT_INLINE static V3 AbsorptionOf(V3 reflectance, VF n) {
    VF k = MulAddScalar(n, 0.245f, Splat(5.574f));
    k = hn::MulAdd(k, n, Splat(-10.73f));
    k = hn::MulAdd(k, n, Splat(2.532f));
    k = hn::MulAdd(k, n, Splat(-0.215f));
    k = hn::MulAdd(k, n, Splat(5.969f));
    const auto of = [&](VF r) HWY_ATTR {
      return Sqr(hn::Div(hn::Log(DF(), hn::Max(r, Splat(1e-37f))), k));
    };
    return {of(reflectance.x), of(reflectance.y), of(reflectance.z)};
  }

  LANELIGHT_INLINE static VF Power(VF x, int exponent) {
    VF power = Splat(1.0f);
    for (; exponent > 0; exponent >>= 1, x = Sqr(x)) {
      if (exponent & 1) power = hn::Mul(power, x);
    }
    return power;
  }

  /// The lobes for a direction wo: mean inclinations, azimuths, attenuation, and the
  /// probability of choosing each.
  struct Lobes {
    Incline o[kLobes];
    VF phi_o, turn[kLobes - 1];
    V3 light[kLobes];
    VF fraction[kLobes];
  };

  LANELIGHT_INLINE static VF Variance(const Params& m, int p) {
    return p == 0 ? m.variance : hn::Mul(m.variance, Splat(p == 1 ? 0.25f : 4.0f));
  }

  /// Scales tilt the lobes by -2, 1 and 4 times their angle.
  LANELIGHT_INLINE static void Tilt(const Params& m, const Incline& o, Lobes& lobes) {
    constexpr float kTimes[] = {-2, 1, 4, 0};
    for (int p = 0; p < kLobes; ++p) {
      const SinCosPair a = SinCos2Pi(hn::Mul(m.tilt, Splat(kTimes[p] / kTwoPi)));
      const VF sin = hn::MulAdd(o.sin, a.cos, hn::Mul(o.cos, a.sin));
      const VF cos = hn::NegMulAdd(o.sin, a.sin, hn::Mul(o.cos, a.cos));
      lobes.o[p] = {sin, hn::Abs(cos)};
    }
  }

  LANELIGHT_INLINE static void Absorb(VF fresnel, V3 passed, Lobes& lobes) {
    const VF enters = hn::Sub(Splat(1.0f), fresnel), one = Splat(1.0f);
    lobes.light[0] = Grey(fresnel);
    lobes.light[1] = Mul(passed, Sqr(enters));
    const V3 again = Mul(passed, fresnel);
    lobes.light[2] = Mul(lobes.light[1], again);
    const V3 rest = Mul(lobes.light[2], again);
    const auto all = [&](VF first, VF ratio) HWY_ATTR {
      return hn::Div(first, hn::Max(hn::Sub(one, ratio), Splat(1e-20f)));
    };
    lobes.light[3] = {all(rest.x, again.x), all(rest.y, again.y), all(rest.z, again.z)};
    VF sum = hn::Zero(DF());
    for (int p = 0; p < kLobes; ++p) {
      const V3 a = lobes.light[p];
      lobes.fraction[p] = hn::Add(a.x, hn::Add(a.y, a.z));
      sum = hn::Add(sum, lobes.fraction[p]);
    }
    // At an index of 1 along the fibre the sum can be 0.
    const VF all_light = hn::Max(sum, Splat(1e-30f));
    for (VF& fraction : lobes.fraction) fraction = hn::Div(fraction, all_light);
  }

  LANELIGHT_INLINE static Lobes LobesOf(const Params& m, V3 wo) {
    const VF one = Splat(1.0f);
    const Incline o = InclineOf(wo.x), at = InclineOf(m.h);
    // Inside the fibre, with the index for the projection on the plane across it.
    const Incline inside = InclineOf(hn::Div(o.sin, m.eta));
    const VF across = SafeSqrt(hn::MulSub(m.eta, m.eta, Sqr(o.sin)));
    const VF sin_t = hn::Div(hn::Mul(m.h, o.cos), hn::Max(across, Splat(1e-18f)));
    const Incline bent = InclineOf(hn::Clamp(sin_t, hn::Neg(one), one));
    const VF length =
        hn::Mul(Splat(-2.0f), hn::Div(bent.cos, hn::Max(inside.cos, Splat(1e-18f))));
    const auto pass = [&](VF a) HWY_ATTR {
      return Exp(hn::Max(hn::Mul(a, length), Splat(-1e30f)));
    };
    const V3 passed = {pass(m.absorption.x), pass(m.absorption.y), pass(m.absorption.z)};
    Lobes lobes;
    Tilt(m, o, lobes);
    Absorb(DielectricInterface(hn::Mul(o.cos, at.cos), m.eta).reflectance, passed, lobes);
    lobes.phi_o = Atan2(wo.z, wo.y);
    const VF gamma_o = Atan2(at.sin, at.cos), gamma_t = Atan2(bent.sin, bent.cos);
    for (int p = 0; p < kLobes - 1; ++p) {
      const float times = static_cast<float>(p);
      lobes.turn[p] = hn::MulAdd(Splat(2 * times), gamma_t,
                                 MulAddScalar(gamma_o, -2, Splat(times * kPi)));
    }
    return lobes;
  }

  LANELIGHT_INLINE static BsdfValue ValueOf(const Params& m, const Lobes& lobes, V3 wi) {
    const Incline i = InclineOf(wi.x);
    const VF phi = hn::Sub(Atan2(wi.z, wi.y), lobes.phi_o);
    BsdfValue sum = {Splat3(0, 0, 0), hn::Zero(DF())};
    for (int p = 0; p < kLobes; ++p) {
      const VF around =
          p < kLobes - 1 ? m.around.Pdf(hn::Sub(phi, lobes.turn[p])) : Splat(1 / kTwoPi);
      const VF density = hn::Mul(AlongFibre(i, lobes.o[p], Variance(m, p)), around);
      sum.f_cos = MulAdd(lobes.light[p], density, sum.f_cos);
      sum.pdf = hn::MulAdd(lobes.fraction[p], density, sum.pdf);
    }
    return sum;
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    return ValueOf(m, LobesOf(m, wo), wi);
  }

  /// A lobe, chosen by u, which is stretched to [0, 1) again.
  struct Chosen {
    Incline o;
    VF variance, turn, u;
    MF rest;  // the last lobe
  };
  LANELIGHT_INLINE static Chosen Choose(const Params& m, const Lobes& lobes, VF u) {
    const DF df;
    Chosen c = {lobes.o[0], Variance(m, 0), lobes.turn[0], u, hn::FirstN(df, 0)};
    VF begin = hn::Zero(df), fraction = lobes.fraction[0];
    for (int p = 1; p < kLobes; ++p) {
      const VF next = hn::Add(begin, fraction);
      const MF later = hn::And(hn::Ge(u, next), hn::Gt(lobes.fraction[p], hn::Zero(df)));
      begin = hn::IfThenElse(later, next, begin);
      fraction = hn::IfThenElse(later, lobes.fraction[p], fraction);
      c.o.sin = hn::IfThenElse(later, lobes.o[p].sin, c.o.sin);
      c.o.cos = hn::IfThenElse(later, lobes.o[p].cos, c.o.cos);
      c.variance = hn::IfThenElse(later, Variance(m, p), c.variance);
      if (p < kLobes - 1) c.turn = hn::IfThenElse(later, lobes.turn[p], c.turn);
      c.rest = p < kLobes - 1 ? c.rest : later;
    }
    c.u = hn::Clamp(hn::Div(hn::Sub(u, begin), fraction), hn::Zero(df),
                    Splat(0x1.fffffep-1f));
    return c;
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo,
                                                    const BsdfPoints& u) {
    const Lobes lobes = LobesOf(m, wo);
    const Chosen c = Choose(m, lobes, u.lobe);
    // 1 - the cosine from the mirror direction.
    const VF tail = Exp(hn::Div(Splat(-2.0f), c.variance));
    const VF mass = hn::MulAdd(hn::Sub(Splat(1.0f), u.u0), tail, u.u0);
    const VF lift =
        hn::Min(hn::Neg(hn::Mul(c.variance, hn::Log(DF(), hn::Max(mass, Splat(1e-9f))))),
                Splat(2.0f));
    const VF cos = hn::Sub(Splat(1.0f), lift);
    const VF sin = SafeSqrt(hn::Mul(lift, hn::Sub(Splat(2.0f), lift)));
    const VF turned = hn::Mul(hn::Mul(sin, SinCos2Pi(u.u1).cos), c.o.cos);
    const VF sin_i =
        hn::Clamp(hn::NegMulAdd(cos, c.o.sin, turned), Splat(-1.0f), Splat(1.0f));
    const Incline i = InclineOf(sin_i);
    const VF around = hn::IfThenElse(c.rest, hn::Mul(Splat(kTwoPi), c.u),
                                     hn::Add(c.turn, m.around.Sample(c.u)));
    const VF phi = hn::Mul(hn::Add(lobes.phi_o, around), Splat(1 / kTwoPi));
    const SinCosPair a = SinCos2Pi(phi);
    const V3 wi = {i.sin, hn::Mul(i.cos, a.cos), hn::Mul(i.cos, a.sin)};
    const BsdfValue value = ValueOf(m, lobes, wi);
    const VF inverse = hn::Div(Splat(1.0f), hn::Max(value.pdf, Splat(1e-30f)));
    return {wi, Mul(value.f_cos, inverse), value.pdf, Splat(1.0f)};
  }
};

LANELIGHT_END_KERNELS

#endif
