// Option "forcediffuse": every surface scatters evenly, with the weight of a direction
// sampled from its material. The mean of that weight is the reflectance, to both sides,
// for light towards the viewer (pbrt-v4, SurfaceInteraction::GetBSDF).
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/kinds-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Bsdf>
HWY_NOINLINE V3 SampledReflectance(const SurfaceReader<Bsdf>& reader,
                                   const Slots& slots) {
  const PathColumns& p = reader.wave.path;
  const ShadingFrame frame =
      reader.ReadFrame(Gather3(p.ng_x, p.ng_y, p.ng_z, slots), slots);
  const V3 wo = frame.ToLocal(-Gather3(p.d_x, p.d_y, p.d_z, slots));
  // Numbers of a stream of their own: those of the bounce still choose the direction.
  VF u[4];
  LaneRandom(p, slots, reader.wave.run->seed ^ 0x51ed270bu).Next4(u);
  const auto material = Bsdf::Load(reader.Inputs(slots));
  const V3 weight = Bsdf::Sample(material, wo, {u[0], u[1], u[2]}).weight;
  const MF sampled = hn::And(CarriesLight(weight), hn::Ne(wo.z, hn::Zero(DF())));
  return IfThenElseZero(sampled, weight);
}

template <class Bsdf, ShadeKind kKind>
HWY_INLINE void ForceKind(Wave& wave) {
  if constexpr (!HasTrait(kKind, kInMedium)) {
    const PathColumns& p = wave.path;
    const MaterialTable& materials = *wave.materials;
    if (!(materials.forced_kinds >> static_cast<int>(kKind) & 1)) return;
    const Queue& mine = FilterQueue(
        wave, wave.queue(QueueId::kSurface), [&](const Slots& slots) HWY_ATTR {
          const VI kind = Lookup(materials.kind, Gather(p.material, slots));
          const VI wanted = hn::Set(DI(), static_cast<int32_t>(kKind));
          return hn::RebindMask(DF(), hn::Eq(kind, wanted));
        });
    const SurfaceReader<Bsdf> reader(wave);
    const VI forced = hn::Set(DI(), static_cast<int32_t>(materials.forced));
    ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
      const V3 color = SampledReflectance(reader, slots);
      Scatter3(color, p.color0_r, p.color0_g, p.color0_b, slots);
      Scatter(forced, p.material, slots);
    });
  }
}

// A path whose material has been replaced may be filtered again by its new kind, which
// returns the same colour.
void ForceDiffuse(Wave& wave){
#define X(name, traits, meaning) ForceKind<name##Bsdf, ShadeKind::k##name>(wave);
    LANELIGHT_SHADE_KINDS(X)
#undef X
}

Stage ForceDiffuseStage() {
  using namespace fields;
  const FieldSet color = {Field::color0_r, Field::color0_g, Field::color0_b};
  const FieldSet identity = {Field::pixel, Field::sample, Field::branch, Field::depth};
  return {.name = "force_diffuse",
          .meaning = "replaces all materials by the model of --scattering",
          .input = QueueId::kSurface,
          .role = StageRole::kShade,
          .needs = {Feature::kForcedDiffuse, Feature::kScatters},
          .reads = kNormal | kTangent | kParameters | identity |
                   FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::uv_v,
                            Field::wavelength, Field::material},
          .writes = color | FieldSet{Field::material},
          .resolve = Always<ForceDiffuse>};
}

LANELIGHT_END_KERNELS
