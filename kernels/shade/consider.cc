// light-candidates=resampled: weighs each candidate and decides whether it is kept
// (kernels/lights/candidates.cc has the estimator).
//
// The weight of a candidate (`candidate_weight`) is the luminance that the shading stage
// would carry along the shadow ray: throughput, material, cosine, radiance over density,
// and the MIS weight with the density of the material alone. Cheaper bounds such as
// radiance times cosine select light that glossy surfaces do not reflect. Coats over
// metal, whose value is a random walk, use such a bound.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/kinds-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

// A candidate replaces the kept one with probability candidate_weight / (sum of the
// weights so far), so that finally each has been kept with probability candidate_weight /
// sum. One number serves all choices: the remainder after a choice is stretched back to
// [0, 1).
struct Reservoir {
  VF sum, u;

  // Returns whether the candidate is taken. `candidate_weight` is finite and at least 0;
  // 0 is never taken, the first above 0 always is.
  HWY_INLINE MF Accept(VF candidate_weight) {
    sum = hn::Add(sum, candidate_weight);
    const MF some = hn::Gt(candidate_weight, hn::Zero(DF()));
    const VF fraction = hn::IfThenElseZero(some, hn::Div(candidate_weight, sum));
    const MF replaces = hn::Lt(u, fraction);
    const VF one = Splat(1.0f);
    const VF part = hn::IfThenElse(replaces, fraction, hn::Sub(one, fraction));
    const VF left = hn::Div(hn::IfThenElse(replaces, u, hn::Sub(u, fraction)), part);
    u = hn::Min(left, Splat(0x1.fffffep-1f));
    return replaces;
  }
};

// Worths are clamped here, so that no sum of them overflows.
inline constexpr float kMaxCandidateWeight = 1e36f;

HWY_INLINE VF Luminance(V3 c) {
  return hn::MulAdd(c.x, Splat(0.212671f),
                    hn::MulAdd(c.y, Splat(0.715160f), hn::Mul(c.z, Splat(0.072169f))));
}

// Stores in the lanes of `replaces`; the others keep their values.
HWY_INLINE void Replace(MF replaces, VF value, float* column, const StoreSlots& slots) {
  Scatter(hn::IfThenElse(replaces, value, Gather(column, slots)), column, slots);
}

// Makes the light sample in ls_* the kept one in the lanes of `replaces`.
HWY_INLINE void KeepSample(const PathColumns& p, MF replaces, VF candidate_weight,
                           const StoreSlots& slots) {
  const auto copy = [&](const float* from, float* to)
                        HWY_ATTR { Replace(replaces, Gather(from, slots), to, slots); };
  copy(p.ls_x, p.kept_x), copy(p.ls_y, p.kept_y), copy(p.ls_z, p.kept_z);
  copy(p.ls_r, p.kept_r), copy(p.ls_g, p.kept_g), copy(p.ls_b, p.kept_b);
  copy(p.ls_distance, p.kept_distance);
  copy(p.ls_pdf, p.kept_pdf);
  if (p.ls_light != nullptr) {
    copy(reinterpret_cast<const float*>(p.ls_light),
         reinterpret_cast<float*>(p.kept_light));
  }
  Replace(replaces, candidate_weight, p.candidate_weight, slots);
}

// Advances numbers in [0, 1) on the grid of 24 bits by `step` of that grid modulo 1:
// exact, so that uniform numbers stay uniform.
HWY_INLINE void Advance(float* column, float step, const StoreSlots& slots) {
  const VF moved = hn::Sub(Gather(column, slots), Splat(1.0f - step));
  const MF below = hn::Lt(moved, hn::Zero(DF()));
  Scatter(hn::IfThenElse(below, hn::Add(moved, Splat(1.0f)), moved), column, slots);
}

// Returns the nearest number on that grid.
constexpr float OnGrid(double step) {
  return static_cast<float>(static_cast<std::int32_t>(step * 0x1p24 + 0.5)) * 0x1p-24f;
}

// Advances the numbers of a light sample to those of the next of `count` candidates: the
// choice of light by 1 / count, which spreads candidates evenly over the lights, points
// by powers of the generalised golden ratio (Roberts 2018).
HWY_INLINE void AdvanceCandidate(const PathColumns& p, std::uint32_t count,
                                 const StoreSlots& slots) {
  if (p.u_select != nullptr) Advance(p.u_select, OnGrid(1.0 / count), slots);
  Advance(p.u_light_0, OnGrid(0.7548776662466927), slots);
  Advance(p.u_light_1, OnGrid(0.5698402909980532), slots);
}

template <class Bsdf>
HWY_INLINE V3 Reflected(const SurfaceReader<Bsdf>& reader, const MisParameters& mis,
                        V3 wo, V3 wi, const Slots& slots) {
  if constexpr (Bsdf::kStochastic) {
    static_assert(!Bsdf::kTransmits);
    // At least 0.05: at grazing angles a coat reflects more than its cosine.
    const VF bound = hn::Max(hn::Abs(wi.z), Splat(0.05f));
    return Grey(hn::IfThenElseZero(SameSide(wo, wi), bound));
  } else {
    const BsdfValue value = Bsdf::Eval(Bsdf::Load(reader.Inputs(slots)), wo, wi);
    return Mul(value.f_cos,
               LightSampleWeight(mis, Gather(reader.wave.path.ls_pdf, slots), value.pdf));
  }
}

template <class Bsdf>
HWY_INLINE VF CandidateWeight(const SurfaceReader<Bsdf>& reader, const MisParameters& mis,
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
                            hn::Min(Luminance(carried), Splat(kMaxCandidateWeight)));
}

template <class Bsdf, ShadeKind kKind>
HWY_NOINLINE void ConsiderKind(Wave& wave) {
  const PathColumns& p = wave.path;
  const SurfaceReader<Bsdf> reader(wave);
  // Without scattered rays that find lights, light samples count in full.
  const MisParameters mis =
      wave.run->features.Has(Feature::kMis) ? wave.run->mis : MisParameters{0, 0, 0};
  ForEachBatch(
      wave, wave.queue(ShadeQueue(kKind)), [&](const StoreSlots& slots, MF) HWY_ATTR {
        Reservoir reservoir = {Gather(p.candidate_weight_sum, slots),
                               Gather(p.u_candidate, slots)};
        const VF candidate_weight = CandidateWeight(reader, mis, slots);
        KeepSample(p, reservoir.Accept(candidate_weight), candidate_weight, slots);
        Scatter(reservoir.sum, p.candidate_weight_sum, slots);
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
                            Field::u_candidate, Field::candidate_weight_sum};
  return {.name = "light_consider",
          .meaning = "keeps the new candidate or the previous one",
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
