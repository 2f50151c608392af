// control=regression: the first two choices of a path between lobes.
//   function    phi ~ 1[u < p] - p, u the number that chooses, p the probability of the
//               first lobe (of glass: its Fresnel reflectance)
//   unbiased    E[phi] = 0 for every p that is known before u is drawn. Where the
//               material does not decide (directions=uniform) p is not the probability,
//               but u is as uniform: less is explained
//   variance    if the lobes bring A and B, all of p (1 - p) (A - B)^2 goes away: what
//               the camera sees of clear glass is little else than noise of this kind
//   cost        a Fresnel term per event with a choice; none without such materials
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/shade/shade-inl.h"
#include "src/vocabulary/path/dimensions.h"

LANELIGHT_BEGIN_KERNELS

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
    const DI di;
    const VI code = ChoiceCodes<Bsdf>(reader, slots), had = Gather(path.choices, slots);
    const auto none = hn::Eq(had, hn::Zero(di));
    const auto one = hn::Eq(hn::ShiftRight<16>(had), hn::Zero(di));
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
