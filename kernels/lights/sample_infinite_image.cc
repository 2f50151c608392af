// Light samples of environment images: a texel with probability proportional to its
// luminance, then uniform inside it (the map has equal area everywhere).
//   density     pdf_sa = pmf * P(texel) * size^2 / (4 pi)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/environment-inl.h"
#include "kernels/lights/light_stage.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SampleInfiniteImage(Wave& wave) {
  const PathColumns& p = wave.path;
  SampleMaps<kMany>(wave, LightShape::kInfiniteImage, wave.chances->environments.size(),
                    offsetof(LightRecord, environment),
                    [&](std::size_t map, const StoreSlots& slots) HWY_ATTR {
                      return SampleEnvironment(wave, map, Gather(p.u_light_0, slots),
                                               Gather(p.u_light_1, slots));
                    });
}

Stage SampleInfiniteImageStage() {
  return SampleLightStage("light_infinite_image", "samples environment images",
                          Feature::kInfiniteImage,
                          ByFeature<Feature::kManyLights, SampleInfiniteImage<true>,
                                    SampleInfiniteImage<false>>);
}

LANELIGHT_END_KERNELS
