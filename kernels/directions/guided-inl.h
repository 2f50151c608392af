// guiding=radiance: directions by the guide or by the material, one of the two at random.
//   estimator   f |cos| / (c g + (1 - c) q), g the guide's density, q the material's, c
//               the fraction of the cell: the one-sample model with the balance heuristic
//   delta       lobes that no density finds are found by the material alone, hence with
//               1 / (1 - c) times their weight; c < 1
//   proxies     a material may report as q any function of both directions that Eval and
//               Sample agree on (bsdf/coated_conductor-inl.h): with the material's own
//               weight w its samples count as w (q / (c g + (1 - c) q)), the guide's as
//               f |cos| / (c g + (1 - c) q), whose factors c g and (1 - c) q over their
//               sum add up to 1
//   unbiased    for any guide, as c < 1. The guide proposes directions above the surface
//               only (src/prepare/guide_square.h); what lies below is the material's
//   variance    bounded by 1 / (1 - c) times the second moment of the material alone;
//               falls as far as g resembles the light that arrives. Light samples are
//               weighed against the mixture
//   cost        one evaluation of the material more, and two look-ups of g
//   source      Veach and Guibas 1995 (one-sample model); Vorba et al. 2014
#ifndef LANELIGHT_DIRECTIONS_GUIDED_INL_H_
#define LANELIGHT_DIRECTIONS_GUIDED_INL_H_

#include "kernels/bsdf/bsdf-inl.h"
#include "kernels/guide/guide-inl.h"
#include "src/path/wave.h"
#include "src/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

/// A proposal as in material-inl.h, of paths that the guide stage has seen.
struct GuidedProposal {
  static constexpr bool kScales = true;
  static constexpr bool kIsUniform = false;
  const Guide& guide;
  const PathColumns& path;
  const Frame& frame;  // of shading
  const Slots& slots;
  Frame above;  // the guide's, on the side that the path sees
  VI cell;
  VF fraction, rest;  // c, 1 - c

  LANELIGHT_INLINE GuidedProposal(const Wave& wave, const Frame& shading, const Slots& s)
      : guide(wave.run->tables->guide),
        path(wave.path),
        frame(shading),
        slots(s),
        above(GuideFrame(FacingNormal(wave.path, s))),
        cell(Gather(path.guide_cell, slots)),
        fraction(Gather(guide.fraction.data(), cell)),
        rest(hn::Sub(Splat(1.0f), fraction)) {}

  static LANELIGHT_INLINE V3 FacingNormal(const PathColumns& p, const Slots& slots) {
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const V3 n = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
    return IfThenElse(hn::Gt(Dot(n, d), hn::Zero(DF())), -n, n);
  }
  LANELIGHT_INLINE VF PdfOfGuide(V3 wi) const {
    return GuidePdf(guide, cell, above.ToLocal(frame.FromLocal(wi)));
  }
  LANELIGHT_INLINE VF Mixture(VF guide_pdf, VF material_pdf) const {
    return hn::MulAdd(fraction, guide_pdf, hn::Mul(rest, material_pdf));
  }

  template <class Bsdf>
  LANELIGHT_INLINE VF Pdf(const typename Bsdf::Params&, V3, V3 wi,
                          VF material_pdf) const {
    return Mixture(PdfOfGuide(wi), material_pdf);
  }

  template <class Bsdf>
  LANELIGHT_INLINE BsdfSample Sample(const typename Bsdf::Params& material, V3 wo,
                                     const BsdfPoints& u) const {
    const BsdfSample own = Mixed(Bsdf::Sample(material, wo, u));
    const MF guided = hn::Lt(Gather(path.u_guide, slots), fraction);
    if (hn::AllFalse(DF(), guided)) return own;
    const BsdfSample other = Guided<Bsdf>(material, wo);
    return {IfThenElse(guided, other.wi, own.wi),
            IfThenElse(guided, other.weight, own.weight),
            hn::IfThenElse(guided, other.pdf, own.pdf),
            hn::IfThenElse(guided, other.eta_scale, own.eta_scale)};
  }

 private:
  // What roulette multiplies the throughput with, so that it sees the one that the
  // material alone would have brought: a guided ray is light because it is likely.
  static LANELIGHT_INLINE VF Bounded(VF scale) {
    return hn::Min(hn::Max(scale, Splat(1e-4f)), Splat(1e4f));
  }

  // What the material has found, as a sample of the mixture.
  LANELIGHT_INLINE BsdfSample Mixed(const BsdfSample& own) const {
    const VF zero = hn::Zero(DF());
    const VF g = PdfOfGuide(own.wi);
    const MF delta = hn::Eq(own.pdf, zero);
    // (c g + (1 - c) q) / q, which neither overflows nor is 0 times infinity.
    const VF ratio =
        hn::IfThenElse(delta, zero, hn::Min(hn::Div(g, own.pdf), Splat(1e30f)));
    const VF scale = hn::MulAdd(fraction, ratio, rest);
    return {own.wi, Mul(own.weight, hn::Div(Splat(1.0f), scale)),
            hn::IfThenZeroElse(delta, Mixture(g, own.pdf)),
            hn::Mul(own.eta_scale, Bounded(scale))};
  }

  // What the guide has proposed.
  template <class Bsdf>
  LANELIGHT_INLINE BsdfSample Guided(const typename Bsdf::Params& material, V3 wo) const {
    const V3 wi = frame.ToLocal(Gather3(path.guide_x, path.guide_y, path.guide_z, slots));
    const BsdfValue value = Bsdf::Eval(material, wo, wi);
    const VF pdf = Mixture(Gather(path.guide_pdf, slots), value.pdf);
    VF eta_scale = Splat(1.0f);
    if constexpr (Bsdf::kRefracts) eta_scale = Bsdf::EtaScale(material, wo, wi);
    const VF scale = Bounded(hn::Div(pdf, hn::Max(value.pdf, Splat(1e-30f))));
    return {wi, Mul(value.f_cos, hn::Div(Splat(1.0f), pdf)), pdf,
            hn::Mul(eta_scale, scale)};
  }
};

LANELIGHT_END_KERNELS

#endif
