// control=regression: h is a polynomial in the numbers that drive the first scattered
// direction of a path, and linear in its first choices between lobes, fitted to samples
// of the neighbourhood.
//   estimator   f - c sum_j b_j phi_j(u), E[phi_j] = 0: the functions, the fit and what
//               makes it unbiased are in src/render/films/regression_film.h. Here the
//               numbers are kept: position in the pixel; direction and light point of the
//               first event that is not specular (mirrors and clear glass do not use
//               them); the first two choices
//   unbiased    a number is uniform whatever came before it in the path (a martingale),
//               even if the material does not use it
//   variance    removes the share of f that is additive and quadratic in these numbers:
//               (1 - R^2) of the variance remains, for lights of all kinds. Stratified
//               and low-discrepancy points integrate that share already (Hickernell,
//               Lemieux and Owen 2005): there the gain is small, as with rare bright
//               samples
//   cost        per sample six multiply-adds per function, and a fit at the end (and at
//               looks at the error): sums over blocks of 4 x 4 pixels; some 750 bytes per
//               pixel
//   source      Salaun et al. 2022, "Regression-based Monte Carlo Integration"; Lavenberg
//               and Welch 1981, "A Perspective on the Use of Control Variables" (optimal
//               c, what the fit costs); Nelson 1990, "Control Variate Remedies" (halves)
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/shade/shade-inl.h"
#include "src/vocabulary/path/dimensions.h"

LANELIGHT_BEGIN_KERNELS

// As PairCode.
HWY_INLINE VI PairCodes(VF first, VF second) {
  const DI di;
  const VI high = hn::ConvertTo(di, hn::Mul(first, Splat(1 << kBitsOfFirst)));
  const VI low = hn::ConvertTo(di, hn::Mul(second, Splat(1 << kBitsOfSecond)));
  const VI has = hn::BitCast(di, hn::Set(DU(), kHasPair));
  return hn::Or(has, hn::Or(hn::ShiftLeft<kBitsOfSecond>(high), low));
}

void FirstFilm(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kCamera), [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(PairCodes(Gather(p.u_film_0, slots), Gather(p.u_film_1, slots)), p.first_film,
            slots);
  });
}

// Returns whether the kind has delta directions only.
HWY_INLINE hn::Mask<DI> IsSpecular(VI kind) {
  auto specular = hn::Lt(kind, hn::Zero(DI()));
  for (int k = 0; k < kNumShadeKinds; ++k) {
    if (!HasTrait(static_cast<ShadeKind>(k), kSpecularOnly)) continue;
    specular = hn::Or(specular, hn::Eq(kind, hn::Set(DI(), k)));
  }
  return specular;
}

void FirstBounce(Wave& wave) {
  const PathColumns& p = wave.path;
  const MaterialTable& m = *wave.materials;
  const Queue& first =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        const auto open = hn::Eq(Gather(p.first_bsdf, slots), hn::Zero(DI()));
        const VI kind = Lookup(m.kind, Gather(p.material, slots));
        return hn::RebindMask(DF(), hn::AndNot(IsSpecular(kind), open));
      });
  ForEachBatch(wave, first, [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(PairCodes(Gather(p.u_bsdf_0, slots), Gather(p.u_bsdf_1, slots)), p.first_bsdf,
            slots);
    if (p.u_light_0 == nullptr) return;
    Scatter(PairCodes(Gather(p.u_light_0, slots), Gather(p.u_light_1, slots)),
            p.first_light, slots);
  });
}

Stage FirstFilmStage() {
  return {.name = "control_first_film",
          .meaning = "keeps the position in the pixel",
          .input = QueueId::kCamera,
          .role = StageRole::kSampling,
          .needs = {Feature::kRegressionControl},
          .reads = {Field::u_film_0, Field::u_film_1},
          .writes = {Field::first_film},
          .resolve = Always<FirstFilm>};
}
Stage FirstBounceStage() {
  return {.name = "control_first_bounce",
          .meaning = "keeps the random numbers of the first scattered direction",
          .input = QueueId::kVertex,
          .role = StageRole::kSampling,
          .needs = {Feature::kRegressionControl, Feature::kScatters},
          .reads = fields::kBounceNumbers | FieldSet{Field::material, Field::first_bsdf},
          .writes = {Field::first_bsdf, Field::first_light},
          .resolve = Always<FirstBounce>};
}

// The first two choices of a path between lobes.
//   function    phi ~ 1[u < p] - p, u the number that chooses, p the probability of the
//               first lobe (of glass: its Fresnel reflectance)
//   unbiased    E[phi] = 0 for every p that is known before u is drawn. With
//               directions=uniform p is not the probability, but u is as uniform: less is
//               explained
//   variance    if the lobes bring A and B, all of p (1 - p) (A - B)^2 goes away: the
//               noise of clear glass is mostly of this kind
//   cost        a Fresnel term per event with a choice; none without such materials

// As ChoiceCode, of 16 bits.
template <class Bsdf>
HWY_INLINE VI ChoiceCodes(const SurfaceReader<Bsdf>& reader, const Slots& slots) {
  const DI di;
  const PathColumns& path = reader.wave.path;
  const ShadingFrame frame =
      reader.ReadFrame(Gather3(path.ng_x, path.ng_y, path.ng_z, slots), slots);
  const V3 wo = frame.ToLocal(-Gather3(path.d_x, path.d_y, path.d_z, slots));
  const VF scale = Splat(1 << kBitsOfProbability);
  const VF p = Bsdf::FirstLobe(Bsdf::Load(reader.Inputs(slots)), wo);
  const VI code = hn::Min(hn::ConvertTo(di, hn::Mul(p, scale)),
                          hn::Set(di, (1 << kBitsOfProbability) - 1));
  const MF first =
      hn::Lt(hn::Mul(Gather(path.u_lobe, slots), scale), hn::ConvertTo(DF(), code));
  return hn::Or(hn::ShiftLeft<1>(code),
                hn::IfThenElseZero(hn::RebindMask(di, first), hn::Set(di, 1)));
}

template <class Bsdf, ShadeKind kKind>
void Choices(Wave& wave) {
  const PathColumns& path = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  ForEachBatch(wave, wave.queue(ShadeQueue(kKind)), [&](const Slots& slots, MF) HWY_ATTR {
    const VI code = ChoiceCodes<Bsdf>(reader, slots), had = Gather(path.choices, slots);
    const auto none = hn::Eq(had, hn::Zero(DI()));
    const auto one = hn::Eq(hn::ShiftRight<16>(had), hn::Zero(DI()));
    const VI second = hn::IfThenElse(one, hn::Or(had, hn::ShiftLeft<16>(code)), had);
    Scatter(hn::IfThenElse(none, code, second), path.choices, slots);
  });
}

template <class Bsdf, ShadeKind kKind>
Stage ChoiceStage(const char* name) {
  using namespace fields;
  return {.name = name,
          .meaning = "keeps the first choices between lobes",
          .input = ShadeQueue(kKind),
          .role = StageRole::kShade,
          .needs = {Feature::kRegressionControl, ShadeFeature(kKind)},
          .reads = kNormal | kParameters |
                   FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::material,
                            Field::u_lobe, Field::choices},
          .writes = {Field::choices},
          .resolve = Always<Choices<Bsdf, kKind>>};
}

Stage ChooseGlassStage() {
  return ChoiceStage<DielectricSmoothBsdf, ShadeKind::kDielectricSmooth>(
      "control_choice_glass");
}
Stage ChooseThinGlassStage() {
  return ChoiceStage<ThinDielectricBsdf, ShadeKind::kThinDielectric>(
      "control_choice_thin");
}
Stage ChooseSheetStage() {
  return ChoiceStage<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>(
      "control_choice_sheet");
}
Stage ChooseCoatStage() {
  return ChoiceStage<CoatedDiffuseSmoothBsdf, ShadeKind::kCoatedDiffuseSmooth>(
      "control_choice_coat");
}
Stage ChooseRoughCoatStage() {
  return ChoiceStage<CoatedDiffuseRoughBsdf, ShadeKind::kCoatedDiffuseRough>(
      "control_choice_rough_coat");
}

LANELIGHT_END_KERNELS
