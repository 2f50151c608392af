// Light samples on emitting shapes with an image: what the image has at the sampled
// point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_image_samples.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/sampled_points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void ImageSamples(Wave& wave) {
  MultiplySamples<kMany>(
      wave, [&](const StoreSlots&, const Lights& light, const PlacedPoint& at)
                HWY_ATTR { return ImageAt(*wave.scene, light, {at.u, at.v}); });
}

void ImageSamplesOne(Wave& wave) { ImageSamples<false>(wave); }
void ImageSamplesMany(Wave& wave) { ImageSamples<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(ImageSamplesOne);
HWY_EXPORT(ImageSamplesMany);

Stage EmissionImageSamplesStage() {
  return EmittedThereStage(
      "light_emission_image", "what the images of emitting shapes have at sampled points",
      Feature::kEmissionImages, [](const FeatureSet& features) -> StageFn {
        return features.Has(Feature::kManyLights) ? HWY_DYNAMIC_DISPATCH(ImageSamplesMany)
                                                  : HWY_DYNAMIC_DISPATCH(ImageSamplesOne);
      });
}

}  // namespace lanelight
#endif  // HWY_ONCE
