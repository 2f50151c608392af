// Light samples on emitting shapes with an image: what the image has at the sampled
// point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/sampled_points-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void ImageSamples(Wave& wave) {
  MultiplySamples<kMany>(
      wave, [&](const StoreSlots&, const Lights& light, const PlacedPoint& at)
                HWY_ATTR { return ImageAt(wave, light, {at.u, at.v}); });
}

Stage EmissionImageSamplesStage() {
  return EmittedThereStage(
      "light_emission_image", "what the images of emitting shapes have at sampled points",
      Feature::kEmissionImages,
      ByFeature<Feature::kManyLights, ImageSamples<true>, ImageSamples<false>>);
}

LANELIGHT_END_KERNELS
