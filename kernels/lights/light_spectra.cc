// Light samples at the wavelengths of their paths.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void LightSpectra(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kLit), [&](const StoreSlots& slots, MF) HWY_ATTR {
        VI light = hn::Zero(DI());
        if constexpr (kMany) light = Gather(p.ls_light, slots);
        const V3 color = Gather3(p.ls_r, p.ls_g, p.ls_b, slots);
        Scatter3(AtWavelengths(wave, slots, light, color), p.ls_r, p.ls_g, p.ls_b, slots);
      });
}

Stage LightSpectraStage() {
  const FieldSet color = {Field::ls_r, Field::ls_g, Field::ls_b};
  return {.name = "light_spectra",
          .meaning = "converts light samples to wavelengths of paths",
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {Feature::kSpectral, Feature::kLights, Feature::kScatters},
          .reads = color | FieldSet{Field::ls_light, Field::wavelength},
          .writes = color,
          .resolve =
              ByFeature<Feature::kManyLights, LightSpectra<true>, LightSpectra<false>>};
}

LANELIGHT_END_KERNELS
