// Light samples of point lights: a delta direction, radiance I / d^2.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SamplePointLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kPoint, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const V3 to_light = light.F3(offsetof(LightRecord, position)) -
                            Gather3(p.p_x, p.p_y, p.p_z, slots);
        const VF d2 = Dot(to_light, to_light);
        const VF distance = hn::Sqrt(d2);
        const VF factor = hn::Div(Splat(1.0f), hn::Mul(d2, Pmf(wave, slots, index)));
        StoreLightSample(p, slots,
                         {Mul(to_light, hn::Div(Splat(1.0f), distance)), distance,
                          Mul(light.Radiance(), factor), Splat(0), hn::Gt(d2, Splat(0))});
      });
}

Stage SamplePointLightStage() {
  return SampleLightStage(
      "light_point", "connects to point lights", Feature::kPointLights,
      ByFeature<Feature::kManyLights, SamplePointLight<true>, SamplePointLight<false>>);
}

LANELIGHT_END_KERNELS
