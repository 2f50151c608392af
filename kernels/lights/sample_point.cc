// Light samples of point lights: a delta direction, radiance I / d^2.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_point.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/light-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SamplePointLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kPoint, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(*wave.scene, index);
        const V3 to_light = light.F3(offsetof(LightRecord, position)) -
                            Gather3(p.p_x, p.p_y, p.p_z, slots);
        const VF d2 = Dot(to_light, to_light);
        const VF distance = hn::Sqrt(d2);
        const VF factor = hn::Div(Splat(1.0f), hn::Mul(d2, light.Pmf(p, slots)));
        StoreLightSample(p, slots, Mul(to_light, hn::Div(Splat(1.0f), distance)),
                         distance, Mul(light.Radiance(), factor), Splat(0),
                         hn::Gt(d2, Splat(0)));
      });
}

void SamplePointLightOne(Wave& wave) { SamplePointLight<false>(wave); }
void SamplePointLightMany(Wave& wave) { SamplePointLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SamplePointLightOne);
HWY_EXPORT(SamplePointLightMany);

Stage SamplePointLightStage() {
  return SampleLightStage("light_point", "connects to point lights",
                          Feature::kPointLights,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SamplePointLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SamplePointLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
