// Light samples of environment images: a texel with probability proportional to its
// luminance, then uniform inside it (the map has equal area everywhere).
//   density     pdf_sa = pmf * P(texel) * size^2 / (4 pi)
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_infinite_image.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/environment-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SampleInfiniteImage(Wave& wave) {
  const PathColumns& p = wave.path;
  SampleMaps<kMany>(wave, LightShape::kInfiniteImage, wave.scene->lights.environments,
                    offsetof(LightRecord, environment),
                    [&](const Environment& map, const StoreSlots& slots) HWY_ATTR {
                      return SampleEnvironment(map, Gather(p.u_light_0, slots),
                                               Gather(p.u_light_1, slots));
                    });
}

void SampleInfiniteImageOne(Wave& wave) { SampleInfiniteImage<false>(wave); }
void SampleInfiniteImageMany(Wave& wave) { SampleInfiniteImage<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleInfiniteImageOne);
HWY_EXPORT(SampleInfiniteImageMany);

Stage SampleInfiniteImageStage() {
  return SampleLightStage("light_infinite_image", "samples environment images",
                          Feature::kInfiniteImage,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SampleInfiniteImageMany)
                                       : HWY_DYNAMIC_DISPATCH(SampleInfiniteImageOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
