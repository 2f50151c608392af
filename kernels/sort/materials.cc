// Resolves mix materials to one of their two, chosen with the probability of its weight;
// a mix of mixes takes several rounds. The number is a pure function of the path, so the
// choice is the same for any order of evaluation.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/queue/slots-inl.h"
#include "kernels/simd/rng-inl.h"
#include "kernels/texture/texture-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

// Weight of the second material, from its texture where it has one (then the scene has
// texture coordinates: compile sees to it).
template <bool kPlaces>
HWY_INLINE VF MixAmount(const Wave& wave, const Slots& slots, VI material) {
  const MaterialTable& m = *wave.materials;
  const PathColumns& path = wave.path;
  const VF constant = Gather(m.alpha_x.data(), material);
  if (path.uv_u == nullptr) return constant;
  const VI id = Gather(m.alpha_x_texture.data(), material);
  const UvPoint uv = {Gather(path.uv_u, slots), Gather(path.uv_v, slots)};
  if constexpr (kPlaces) {
    const PlacedPoint at = {uv.u, uv.v, Gather3(path.p_x, path.p_y, path.p_z, slots),
                            Gather3(path.ng_x, path.ng_y, path.ng_z, slots)};
    return EvalFloats(*wave.textures, id, at, constant);
  } else {
    return EvalFloats(*wave.textures, id, uv, constant);
  }
}

template <bool kPlaces>
HWY_INLINE void Mix(Wave& wave) {
  const MaterialTable& m = *wave.materials;
  const DI di;
  const VI mix_kind = hn::Set(di, static_cast<int32_t>(ShadeKind::kMix));
  ForEachBatch(wave, wave.queue(QueueId::kSurface), [&](const Slots& slots, MF) HWY_ATTR {
    VI material = Gather(wave.path.material, slots);
    const VU depth = AsUnsigned(Gather(wave.path.depth, slots));
    for (uint32_t round = 0;; ++round) {
      const auto is_mix = hn::Eq(Gather(m.kind.data(), material), mix_kind);
      if (hn::AllFalse(di, is_mix)) break;
      const VF amount = MixAmount<kPlaces>(wave, slots, material);
      // Levels beyond those that have a dimension draw with another seed.
      const VU key =
          KeyOf(wave.path, Dimension::kMix, depth, slots, round % kMixDimensions);
      const uint32_t seed = wave.run->seed + round / kMixDimensions * 0x9e3779b9u;
      const U4 r =
          Pcg4d({AsUnsigned(Gather(wave.path.pixel, slots)),
                 AsUnsigned(Gather(wave.path.sample, slots)), key, SplatU(seed)});
      const auto second = hn::RebindMask(di, hn::Lt(ToUnit(r.x), amount));
      const VI chosen = hn::IfThenElse(second, Gather(m.mix1.data(), material),
                                       Gather(m.mix0.data(), material));
      material = hn::IfThenElse(is_mix, chosen, material);
    }
    Scatter(material, wave.path.material, slots);
  });
}

Stage MixStage() {
  return {.name = "mix",
          .meaning = "chooses one material of a mix",
          .input = QueueId::kSurface,
          .role = StageRole::kSort,
          .needs = {Feature::kMix, Feature::kScatters},
          .reads = FieldSet{Field::pixel, Field::sample, Field::depth, Field::branch,
                            Field::material} |
                   fields::kUv | fields::kPoint | fields::kNormal,
          .writes = {Field::material},
          .resolve = ByFeature<Feature::kTexturePlaces, Mix<true>, Mix<false>>};
}

// Integrator parameter "regularize": after a bounce that is not specular, surfaces use
// a variant of their material whose small roughnesses are larger (pbrt-v4,
// BSDF::Regularize). Caustics become less noisy but blurred.
void Regularize(Wave& wave) {
  const PathColumns& path = wave.path;
  const AlignedVector<int32_t>& regular = wave.materials->regular;
  ForEachBatch(wave, wave.queue(QueueId::kSurface), [&](const Slots& slots, MF) HWY_ATTR {
    const DI di;
    const MF scattered = hn::Gt(Gather(path.bsdf_pdf, slots), hn::Zero(DF()));
    const VI one = hn::Set(di, 1);
    const VI now = hn::IfThenElse(hn::RebindMask(di, scattered), one,
                                  hn::BitCast(di, Gather(path.regular, slots)));
    Scatter(now, path.regular, slots);
    const VI material = Gather(path.material, slots);
    const VI rougher = Lookup(regular, material);
    Scatter(hn::IfThenElse(hn::Eq(now, one), rougher, material), path.material, slots);
  });
}

Stage RegularizeStage() {
  return {.name = "regularize",
          .meaning = "makes materials rougher after a bounce that is not specular",
          .input = QueueId::kSurface,
          .role = StageRole::kShade,
          .needs = {Feature::kRegularizes, Feature::kScatters},
          .reads = {Field::bsdf_pdf, Field::regular, Field::material},
          .writes = {Field::regular, Field::material},
          .resolve = Always<Regularize>};
}

LANELIGHT_END_KERNELS
