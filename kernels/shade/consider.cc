// light-candidates=resampled: what each candidate is worth, and whether it is kept
// (kernels/lights/candidates.cc has the estimator).
//
// Worth is the luminance of what the shading stage would send along the shadow ray:
// throughput, material, cosine, radiance over density, and the weight against scattered
// rays, with the density of the material alone. Cheaper bounds such as radiance times
// cosine pick what glossy surfaces do not reflect, or what the weight then takes away.
// Coats over metal, whose value is a random walk, make do with such a bound.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/kinds-inl.h"
#include "kernels/lights/reservoir-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

// Without scattered rays that find lights, light samples count in full.
HWY_INLINE MisParameters CandidateMis(const Wave& wave) {
  return wave.run->features.Has(Feature::kMis) ? wave.run->mis : MisParameters{0, 0, 0};
}

template <class Bsdf>
HWY_INLINE V3 Reflected(const SurfaceReader<Bsdf>& reader, const MisParameters& mis,
                        V3 wo, V3 wi, const Slots& slots) {
  if constexpr (Bsdf::kStochastic) {
    static_assert(!Bsdf::kTransmits);
    // Not below a twentieth: at grazing angles a coat reflects more than its cosine says.
    const VF bound = hn::Max(hn::Abs(wi.z), Splat(0.05f));
    return Grey(hn::IfThenElseZero(SameSide(wo, wi), bound));
  } else {
    const BsdfValue value = Bsdf::Eval(Bsdf::Load(reader.Inputs(slots)), wo, wi);
    return Mul(value.f_cos,
               LightSampleWeight(mis, Gather(reader.wave.path.ls_pdf, slots), value.pdf));
  }
}

template <class Bsdf>
HWY_INLINE VF Worth(const SurfaceReader<Bsdf>& reader, const MisParameters& mis,
                    const Slots& slots) {
  const PathColumns& p = reader.wave.path;
  const ShadingFrame frame =
      reader.ReadFrame(Gather3(p.ng_x, p.ng_y, p.ng_z, slots), slots);
  const V3 wo = frame.ToLocal(-Gather3(p.d_x, p.d_y, p.d_z, slots));
  const V3 wi = frame.ToLocal(Gather3(p.ls_x, p.ls_y, p.ls_z, slots));
  const V3 light = Mul(Gather3(p.beta_r, p.beta_g, p.beta_b, slots),
                       Gather3(p.ls_r, p.ls_g, p.ls_b, slots));
  const V3 carried = Mul(Reflected(reader, mis, wo, wi, slots), light);
  return hn::IfThenElseZero(CarriesLight(carried),
                            hn::Min(Luminance(carried), Splat(kMostWorth)));
}

template <class Bsdf, ShadeKind kKind>
HWY_NOINLINE void ConsiderKind(Wave& wave) {
  const PathColumns& p = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  const MisParameters mis = CandidateMis(wave);
  ForEachBatch(
      wave, wave.queue(ShadeQueue(kKind)), [&](const StoreSlots& slots, MF) HWY_ATTR {
        Reservoir reservoir = {Gather(p.worth_sum, slots), Gather(p.u_candidate, slots)};
        const VF worth = Worth(reader, mis, slots);
        KeepSample(p, reservoir.Take(worth), worth, slots);
        Scatter(reservoir.sum, p.worth_sum, slots);
        Scatter(reservoir.u, p.u_candidate, slots);
        AdvanceCandidate(p, wave.run->candidates, slots);
      });
}

// The kinds that take light samples are those in kLit.
template <class Bsdf, ShadeKind kKind>
HWY_INLINE void ConsiderIfThere(Wave& wave) {
  if constexpr (!Bsdf::kSpecular) {
    if (wave.queue(ShadeQueue(kKind)).size > 0) ConsiderKind<Bsdf, kKind>(wave);
  }
}

void Consider(Wave& wave){
#define X(name, traits, meaning) ConsiderIfThere<name##Bsdf, ShadeKind::k##name>(wave);
    LANELIGHT_SHADE_KINDS(X)
#undef X
}

Stage ConsiderStage() {
  using namespace fields;
  const FieldSet numbers = {Field::u_select, Field::u_light_0, Field::u_light_1,
                            Field::u_candidate, Field::worth_sum};
  return {.name = "light_consider",
          .meaning = "keeps the candidate, or the one before",
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {Feature::kLightCandidates, Feature::kLights, Feature::kScatters},
          .reads = numbers | kThroughput | kNormal | kTangent | kParameters |
                   kLightSample |
                   FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::uv_v,
                            Field::wavelength, Field::material, Field::ls_light},
          .writes = numbers | kKeptSample,
          .resolve = Always<Consider>};
}

LANELIGHT_END_KERNELS
