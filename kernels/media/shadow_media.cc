// Applies the transmittance of media to shadow rays that no surface stops. Where surfaces
// are all opaque, a shadow ray lies in the medium that it starts in.
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/shadow-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kChanges>
void ShadowMediaOf(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kShadow),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const VI medium = ShadowStartMedium<kChanges>(wave, slots);
                 const V3 o = Gather3(p.p_x, p.p_y, p.p_z, slots);
                 DimShadow(wave, slots, {medium, o, Gather(p.ls_distance, slots), 0});
               });
}

StageFn ResolveShadowMedia(const FeatureSet& features) {
  return features.Has(Feature::kMediumChanges) ? ShadowMediaOf<true>
                                               : ShadowMediaOf<false>;
}

Stage ShadowMediaStage() {
  const FieldSet light = {Field::ls_x, Field::ls_y, Field::ls_z, Field::ls_distance};
  return {.name = "media_dim",
          .meaning = "what media leave of shadow rays",
          .input = QueueId::kShadow,
          .role = StageRole::kMedia,
          .needs = {Feature::kMedia, Feature::kOpaqueShadows, Feature::kLights,
                    Feature::kScatters},
          .reads = light | fields::kShadow | fields::kNormal | fields::kPoint |
                   FieldSet{Field::pixel, Field::sample, Field::depth, Field::branch,
                            Field::crossings} |
                   FieldSet{Field::medium, Field::prim, Field::wavelength},
          .writes = fields::kShadow,
          .resolve = ResolveShadowMedia};
}

LANELIGHT_END_KERNELS
