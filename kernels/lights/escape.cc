// Adds every environment to rays that left the scene; their paths end.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/environment-inl.h"
#include "kernels/lights/light-inl.h"
#include "kernels/lights/portal-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMis, bool kPortals>
void Escape(Wave& wave) {
  const PathColumns& p = wave.path;
  const LightTable& table = *wave.lights;
  const float inv_four_pi = 0.0795774715459476679f;
  ForEachBatch(
      wave, wave.queue(QueueId::kMiss), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
        V3 sum = Splat3(0, 0, 0);
        for (uint32_t index : table.infinite) {
          const LightRecord& light = table.lights[index];
          V3 radiance = Splat3(light.radiance[0], light.radiance[1], light.radiance[2]);
          VF pdf = Splat(inv_four_pi);
          if (light.environment >= 0) {
            const MapSample s =
                LookUpEnvironment(wave, static_cast<uint32_t>(light.environment), d);
            radiance = s.radiance;
            pdf = s.pdf_sa;
          }
          if constexpr (kPortals) {
            if (light.shape == static_cast<uint32_t>(LightShape::kPortal)) {
              const V3 from = ScatteredFrom(p, slots);
              const MapSample s = LookThrough(table.portals[light.image], from, d);
              radiance = s.radiance;
              pdf = s.pdf_sa;
            }
          }
          const VI lit = hn::Set(DI(), static_cast<int32_t>(index));
          radiance = AsCarried(wave, slots, lit, radiance);
          if constexpr (kMis) {
            const VF pmf = p.light_row != nullptr && p.light_pmf == nullptr
                               ? LearnedPmf(wave, slots, lit)
                               : Splat(wave.chances->pmf[index]);
            radiance =
                Mul(radiance, EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots),
                                             hn::Mul(pdf, pmf)));
          }
          sum = sum + radiance;
        }
        AddRadiance(p, slots, sum);
      });
}

StageFn ResolveEscape(const FeatureSet& features) {
  const bool portals = features.Has(Feature::kPortals);
  if (features.Has(Feature::kMis))
    return portals ? Escape<true, true> : Escape<true, false>;
  return portals ? Escape<false, true> : Escape<false, false>;
}

Stage EscapeStage() {
  return {.name = "escape",
          .meaning = "adds the environment to rays that left the scene",
          .input = QueueId::kMiss,
          .role = StageRole::kEmission,
          .needs = {Feature::kInfiniteLights},
          .reads = fields::kRay | fields::kThroughput | fields::kRadiance |
                   FieldSet{Field::bsdf_pdf, Field::wavelength, Field::hit_weight,
                            Field::light_row},
          .writes = fields::kRadiance,
          .resolve = ResolveEscape};
}

LANELIGHT_END_KERNELS
