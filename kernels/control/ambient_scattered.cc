// The part of control=ambient that scattered rays estimate (ambient.cc): before roulette,
// which would only add noise to h, and which the expectation knows nothing of.
#include "kernels/simd/each_target-inl.h"

#include "kernels/control/ambient-inl.h"
#include "kernels/control/apply-inl.h"
#include "kernels/lights/environment-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/prepare/tables.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

// Paths that have just left a surface that the control variate works on.
HWY_INLINE const Queue& FromDiffuse(Wave& wave) {
  const MaterialTable& m = wave.scene->materials;
  return FilterQueue(
      wave, wave.queue(QueueId::kScattered), [&](const Slots& slots) HWY_ATTR {
        const VI kind = Gather(m.kind.data(), Gather(wave.path.material, slots));
        const auto is = [&](ShadeKind k) HWY_ATTR {
          return hn::Eq(kind, hn::Set(DI(), static_cast<int32_t>(k)));
        };
        return hn::RebindMask(
            DF(), hn::Or(is(ShadeKind::kDiffuse), is(ShadeKind::kDiffuseTransmission)));
      });
}

template <bool kMis>
HWY_INLINE VF ScatteredWeight(const Wave& wave, uint32_t index, V3 d,
                              const Slots& slots) {
  if constexpr (!kMis) return Splat(1.0f);
  const LightRecord& light = wave.scene->lights.lights[index];
  VF pdf = Splat(0.0795774715459476679f);  // 1 / (4 pi)
  if (light.environment >= 0) {
    const auto map = static_cast<std::size_t>(light.environment);
    pdf = LookUpEnvironment(wave, map, d).pdf_sa;
  }
  return EmissionWeight(wave.run->mis, Gather(wave.path.bsdf_pdf, slots),
                        hn::Mul(pdf, Splat(wave.chances->pmf[index])));
}

template <bool kMis>
void AmbientScattered(Wave& wave) {
  if (kMis && wave.run->mis.hits == 0) return;  // directions=light
  const PathColumns& path = wave.path;
  ForEachBatch(wave, FromDiffuse(wave), [&](const Slots& slots, MF) HWY_ATTR {
    const V3 d = Gather3(path.d_x, path.d_y, path.d_z, slots);
    V3 sum = Splat3(0, 0, 0);
    for (const AmbientLight& ambient : wave.run->tables->ambient) {
      sum = MulAdd(AmbientAt(wave, slots, ambient, ambient.radiance, d),
                   ScatteredWeight<kMis>(wave, ambient.light, d, slots), sum);
    }
    const V3 beta = Gather3(path.beta_r, path.beta_g, path.beta_b, slots);
    ApplyControl(wave, slots, Mul(beta, sum));
  });
}

Stage AmbientScatteredStage() {
  using namespace fields;
  return {.name = "control_ambient_scattered",
          .meaning = "the environment that scattered rays would see",
          .input = QueueId::kScattered,
          .needs = {Feature::kAmbientControl, Feature::kScatters},
          .reads = kRay | kThroughput | kRadiance | kControl |
                   FieldSet{Field::material, Field::bsdf_pdf, Field::wavelength},
          .writes = kRadiance | kControl,
          .resolve =
              ByFeature<Feature::kMis, AmbientScattered<true>, AmbientScattered<false>>};
}

LANELIGHT_END_KERNELS
