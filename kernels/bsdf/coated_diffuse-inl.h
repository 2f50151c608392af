// Plastic: a dielectric coat over a Lambertian base, in closed form.
//
// The base spreads evenly the light that passes the coat, so only total fluxes matter:
//   f = f_coat + T(wo) T(wi) / (pi eta^2) * rho S,   S = sum_{k < n} (rho Fi)^k
// T: the fraction that reaches the base from outside (and by reciprocity leaves towards
// outside); Fi: the fraction that the coat sends back to the base; 1 / eta^2: radiance
// spreads when it leaves the denser medium. n base bounces: pbrt-v4 follows a random walk
// of at most coat_depth layer crossings, which meets the base at every second one.
// Both faces of the surface are coated.
#ifndef LANELIGHT_BSDF_COATED_DIFFUSE_INL_H_
#define LANELIGHT_BSDF_COATED_DIFFUSE_INL_H_

#include "kernels/bsdf/coat_grid-inl.h"
#include "kernels/bsdf/ggx-inl.h"
#include "kernels/warp/sphere-inl.h"
#include "src/scene/compiled/materials.h"

LANELIGHT_BEGIN_KERNELS

/// The base under a coat.
struct CoatedBase {
  V3 rho_series;  // rho S
  VF inverse_eta2, escape, eta;

  LANELIGHT_INLINE static CoatedBase Load(const MaterialInputs& in) {
    return Load(in, in.Float(in.table.coat_internal));
  }
  LANELIGHT_INLINE static CoatedBase Load(const MaterialInputs& in, VF internal) {
    const MaterialTable& t = in.table;
    const VF eta = in.Float(t.eta);
    const V3 rho = in.Color0();
    const VI one = hn::Set(DI(), 1);
    const VI bounces = hn::ShiftRight<1>(hn::Add(in.Int(t.coat_depth), one));
    return {Mul(rho, Series(Mul(rho, internal), bounces)), hn::Div(Splat(1.0f), Sqr(eta)),
            hn::Sub(Splat(1.0f), internal), eta};
  }

  /// S_n = 1 + x + ... + x^(n-1) by the bits of n from the top: S_2k = S_k (1 + x^k),
  /// S_(k+1) = 1 + x S_k. Without cancellation, and exact in length: under a coat of high
  /// index x comes close to 1, and thousands of terms count.
  LANELIGHT_INLINE static V3 Series(V3 x, VI n) {
    const int longest = hn::GetLane(hn::MaxOfLanes(DI(), n));
    V3 sum = Splat3(0, 0, 0), power = Splat3(1, 1, 1);  // S_k, x^k
    for (int bit = 1 << 30; bit != 0; bit >>= 1) {
      if (bit > longest) continue;
      sum = Mul(sum, power) + sum;
      power = Mul(power, power);
      const MF odd = hn::RebindMask(DF(), hn::TestBit(n, hn::Set(DI(), bit)));
      sum = IfThenElse(odd, Mul(x, sum) + Splat3(1, 1, 1), sum);
      power = IfThenElse(odd, Mul(power, x), power);
    }
    return sum;
  }

  /// Returns f cos of the base, per T(wo) T(wi), towards a wi of that cosine.
  LANELIGHT_INLINE V3 Lambert(VF cos_i) const {
    return Mul(rho_series, hn::Mul(inverse_eta2, PdfCosineHemisphere(cos_i)));
  }

  /// Returns the probability of following the coat's reflection: its share of the
  /// reflectance, of which the base has about T(wo) rho S (1 - Fi).
  LANELIGHT_INLINE VF CoatProbability(VF coat_reflectance, VF t_wo) const {
    const VF base = hn::Mul(hn::Mul(t_wo, escape), MaxComponent(rho_series));
    const VF sum = hn::Add(coat_reflectance, base);
    return hn::Div(coat_reflectance, hn::Max(sum, Splat(1e-30f)));
  }
};

/// Smooth coat: the mirror direction is a delta lobe, sampled with density 0 and left out
/// of Eval; the density of the rest is (1 - its probability) cos / pi.
struct CoatedDiffuseSmoothBsdf : PlainBsdf {
  static constexpr bool kHasDelta = true;
  struct Params {
    CoatedBase base;
    VF thickness;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    if (!in.CoatVaries()) {
      return {CoatedBase::Load(in), in.Float(in.table.coat_thickness)};
    }
    const VF internal = CoatCell::Of(in).Internal(in.table);
    return {CoatedBase::Load(in, internal), in.CoatThickness()};
  }
  LANELIGHT_INLINE static VF Transmittance(const Params& m, const Interface& at) {
    const VF slant = hn::Div(m.thickness, hn::Max(at.cos_t, Splat(1e-6f)));
    return hn::Mul(hn::Sub(Splat(1.0f), at.reflectance), Exp(hn::Neg(slant)));
  }

  LANELIGHT_INLINE static VF FirstLobe(const Params& m, V3 wo) {
    const Interface at = DielectricInterface(hn::Abs(wo.z), m.base.eta);
    return m.base.CoatProbability(at.reflectance, Transmittance(m, at));
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const VF cos_i = hn::Abs(wi.z);
    const Interface at_o = DielectricInterface(hn::Abs(wo.z), m.base.eta);
    const VF to = Transmittance(m, at_o);
    const VF ti = Transmittance(m, DielectricInterface(cos_i, m.base.eta));
    const VF coat = m.base.CoatProbability(at_o.reflectance, to);
    const VF pdf = hn::Mul(hn::Sub(Splat(1.0f), coat), PdfCosineHemisphere(cos_i));
    const MF same = SameSide(wo, wi);
    return {IfThenElseZero(same, Mul(m.base.Lambert(cos_i), hn::Mul(to, ti))),
            hn::IfThenElseZero(same, pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo,
                                                    const BsdfPoints& u) {
    const VF one = Splat(1.0f), tiny = Splat(1e-30f);
    const Interface at_o = DielectricInterface(hn::Abs(wo.z), m.base.eta);
    const VF to = Transmittance(m, at_o);
    const VF coat = m.base.CoatProbability(at_o.reflectance, to);
    const MF mirror = hn::Lt(u.lobe, coat);
    const V3 up = SampleCosineHemisphere(u.u0, u.u1);
    const VF ti = Transmittance(m, DielectricInterface(up.z, m.base.eta));
    const VF rest = hn::Sub(one, coat);
    const VF scale =
        hn::Div(hn::Mul(hn::Mul(to, ti), m.base.inverse_eta2), hn::Max(rest, tiny));
    const VF mirror_weight = hn::Div(at_o.reflectance, hn::Max(coat, tiny));
    const V3 mirrored = {hn::Neg(wo.x), hn::Neg(wo.y), wo.z};
    return {IfThenElse(mirror, mirrored, ToSideOf(wo, up)),
            IfThenElse(mirror, Grey(mirror_weight), Mul(m.base.rho_series, scale)),
            hn::IfThenZeroElse(mirror, hn::Mul(rest, PdfCosineHemisphere(up.z))), one};
  }
};

/// GGX coat: one continuous mixture of the coat's reflection (visible normals) and the
/// cosine lobe of the base. T comes from the table of its material, or from a grid of
/// tables in scenes where layers of coats are textured.
struct CoatedDiffuseRoughBsdf : PlainBsdf {
  static constexpr bool kAnisotropic = true;
  struct Params {
    CoatedBase base;
    Ggx ggx;
    const float* table;
    VI offset;
    bool varies;  // `cell` is used instead of `offset`
    CoatCell cell;
  };
  LANELIGHT_INLINE static Params Load(const MaterialInputs& in) {
    const MaterialTable& t = in.table;
    Params m;
    m.ggx = Ggx::FromAlpha(in.AlphaX(), in.AlphaY());
    m.table = t.coat_transmittance.data();
    m.varies = in.CoatVaries();
    if (m.varies) {
      m.cell = CoatCell::Of(in);
      m.base = CoatedBase::Load(in, m.cell.Internal(t));
    } else {
      m.offset = in.Int(t.coat);
      m.base = CoatedBase::Load(in);
    }
    return m;
  }
  LANELIGHT_INLINE static VF Transmittance(const Params& m, VF mu) {
    const VF at =
        hn::Min(hn::Mul(mu, Splat(kCoatTableSize - 1.0f)), Splat(kCoatTableSize - 1.0f));
    const VI cell = hn::Min(hn::ConvertTo(DI(), at), hn::Set(DI(), kCoatTableSize - 2));
    const VF part = hn::Sub(at, hn::ConvertTo(DF(), cell));
    if (m.varies) return m.cell.Transmittance(m.table, cell, part);
    const VI index = hn::Add(m.offset, cell);
    const VF low = Gather(m.table, index), high = Gather(m.table + 1, index);
    return hn::MulAdd(part, hn::Sub(high, low), low);
  }

  LANELIGHT_INLINE static VF FirstLobe(const Params& m, V3 wo) {
    const VF to = Transmittance(m, hn::Abs(wo.z));
    return m.base.CoatProbability(hn::Sub(Splat(1.0f), to), to);
  }

  enum class Lobes { kBoth, kBase };
  /// Both directions on the upper side; n = their half vector.
  template <Lobes kLobes = Lobes::kBoth>
  LANELIGHT_LONG_BSDF_CALL static BsdfValue EvalUpper(const Params& m, V3 wo, V3 wi,
                                                      V3 n) {
    const VF half = Splat(0.5f), one = Splat(1.0f);
    const VF to = Transmittance(m, wo.z), ti = Transmittance(m, wi.z);
    const VF coat = m.base.CoatProbability(hn::Sub(one, to), to);
    const VF base_pdf = PdfCosineHemisphere(wi.z);
    const V3 base = Mul(m.base.Lambert(wi.z), hn::Mul(to, ti));
    if constexpr (kLobes == Lobes::kBase) {
      return {base, hn::Mul(hn::Sub(one, coat), base_pdf)};
    }
    const VF cosine = hn::Clamp(Dot(wo, n), hn::Zero(DF()), one);
    const VF f = DielectricInterface(cosine, m.base.eta).reflectance;
    const VF half_d = hn::Mul(half, m.ggx.D(n));
    const VF so = m.ggx.StretchedLength(wo), si = m.ggx.StretchedLength(wi);
    const VF reflection =
        hn::Mul(hn::Mul(half_d, f), HalfPairMasking(wo.z, so, wi.z, si));
    const VF coat_pdf = hn::Div(half_d, hn::Add(wo.z, so));
    return {base + Grey(reflection),
            hn::MulAdd(coat, hn::Sub(coat_pdf, base_pdf), base_pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue Eval(const Params& m, V3 wo, V3 wi) {
    const V3 wo_up = {wo.x, wo.y, hn::Abs(wo.z)}, wi_up = {wi.x, wi.y, hn::Abs(wi.z)};
    const BsdfValue value = EvalUpper(m, wo_up, wi_up, Normalize(wo_up + wi_up));
    const MF same = SameSide(wo, wi);
    return {IfThenElseZero(same, value.f_cos), hn::IfThenElseZero(same, value.pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfValue EvalShared(const Params& m, V3 wo, V3 wi) {
    const V3 wo_up = {wo.x, wo.y, hn::Abs(wo.z)}, wi_up = {wi.x, wi.y, hn::Abs(wi.z)};
    const BsdfValue base = EvalUpper<Lobes::kBase>(m, wo_up, wi_up, wi_up);
    const MF same = SameSide(wo, wi);
    return {IfThenElseZero(same, base.f_cos), hn::IfThenElseZero(same, base.pdf)};
  }

  LANELIGHT_LONG_BSDF_CALL static BsdfSample Sample(const Params& m, V3 wo_any,
                                                    const BsdfPoints& u) {
    const VF zero = hn::Zero(DF()), one = Splat(1.0f);
    const V3 wo = {wo_any.x, wo_any.y, hn::Abs(wo_any.z)};
    const VF to = Transmittance(m, wo.z);
    const MF from_coat = hn::Lt(u.lobe, m.base.CoatProbability(hn::Sub(one, to), to));
    const V3 visible = m.ggx.SampleVisible(wo, u.u0, u.u1);
    const VF cosine = hn::Clamp(Dot(wo, visible), zero, one);
    const V3 wi = IfThenElse(from_coat, Reflect(wo, visible, cosine),
                             SampleCosineHemisphere(u.u0, u.u1));
    const MF exists = hn::Gt(wi.z, zero);
    const V3 upper = {wi.x, wi.y, hn::Max(wi.z, Splat(1e-12f))};
    const V3 n = IfThenElse(from_coat, visible, Normalize(wo + upper));
    const BsdfValue value = EvalUpper(m, wo, upper, n);
    const V3 weight = Mul(value.f_cos, hn::Div(one, value.pdf));
    return {ToSideOf(wo_any, wi), IfThenElseZero(exists, weight), value.pdf, one};
  }
};

LANELIGHT_END_KERNELS

#endif
