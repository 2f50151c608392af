// Light samples of distant lights: one delta direction for the whole scene.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SampleDistantLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(wave, LightShape::kDistant,
                    [&](const StoreSlots& slots, VI index) HWY_ATTR {
                      const Lights light(wave, index);
                      const VF pmf = Pmf(wave, slots, index);
                      StoreLightSample(p, slots,
                                       {light.F3(offsetof(LightRecord, direction)),
                                        Splat(std::numeric_limits<float>::infinity()),
                                        Mul(light.Radiance(), hn::Div(Splat(1.0f), pmf)),
                                        Splat(0), hn::Gt(pmf, Splat(0))});
                    });
}

Stage SampleDistantLightStage() {
  return SampleLightStage("light_distant", "connects to distant lights",
                          Feature::kDistantLights,
                          ByFeature<Feature::kManyLights, SampleDistantLight<true>,
                                    SampleDistantLight<false>>);
}

LANELIGHT_END_KERNELS
