// Light samples of distant lights: one delta direction for the whole scene.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_distant.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/light-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SampleDistantLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kDistant, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(*wave.scene, index);
        StoreLightSample(p, slots, light.F3(offsetof(LightRecord, direction)),
                         Splat(std::numeric_limits<float>::infinity()),
                         Mul(light.Radiance(), hn::Div(Splat(1.0f), light.Pmf(p, slots))),
                         Splat(0), hn::Gt(light.Pmf(p, slots), Splat(0)));
      });
}

void SampleDistantLightOne(Wave& wave) { SampleDistantLight<false>(wave); }
void SampleDistantLightMany(Wave& wave) { SampleDistantLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleDistantLightOne);
HWY_EXPORT(SampleDistantLightMany);

Stage SampleDistantLightStage() {
  return SampleLightStage("light_distant", "connects to distant lights",
                          Feature::kDistantLights,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SampleDistantLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SampleDistantLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
