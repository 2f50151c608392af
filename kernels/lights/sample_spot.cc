// Light samples of spot lights: a delta direction, radiance I s(theta) / d^2, where s
// falls from 1 inside the falloff cone to 0 at the edge as a smooth step, as in pbrt-v4.
// Of stretched lights theta is the angle before they are stretched.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_image-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany, bool kStretched>
HWY_INLINE void SampleSpots(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kSpot, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const V3 to_light = light.F3(offsetof(LightRecord, position)) -
                            Gather3(p.p_x, p.p_y, p.p_z, slots);
        const VF d2 = Dot(to_light, to_light);
        const VF distance = hn::Sqrt(d2);
        const V3 direction = Mul(to_light, hn::Div(Splat(1.0f), distance));
        // 1 - cos of the angle to the axis: half the squared distance of the unit
        // vectors. Cosines would not tell cones below 0.02 degrees from nothing.
        V3 aside;
        if constexpr (kStretched) {
          const LightImages axes(*wave.lights, light.I(offsetof(LightRecord, image)));
          aside = Normalize(axes.ToLocal(-direction)) - Splat3(0, 0, 1);
        } else {
          aside = direction + light.F3(offsetof(LightRecord, direction));
        }
        const VF versine = hn::Mul(Splat(0.5f), Dot(aside, aside));
        const VF edge = light.F(offsetof(LightRecord, versine_total));
        const VF width = hn::Sub(edge, light.F(offsetof(LightRecord, versine_falloff)));
        const VF inside = hn::Sub(edge, versine);
        // A cone without falloff (width 0) is a step.
        const VF x = hn::IfThenElse(
            hn::Gt(width, Splat(0)), hn::Div(inside, width),
            hn::IfThenElse(hn::Gt(inside, Splat(0)), Splat(1.0f), Splat(0)));
        const VF s = hn::Min(hn::Max(x, Splat(0)), Splat(1.0f));
        const VF smooth =
            hn::Mul(hn::Mul(s, s), hn::NegMulAdd(Splat(2.0f), s, Splat(3.0f)));
        const VF factor = hn::Div(smooth, hn::Mul(d2, Pmf(wave, slots, index)));
        StoreLightSample(p, slots,
                         {direction, distance, Mul(light.Radiance(), factor), Splat(0),
                          hn::And(hn::Gt(d2, Splat(0)), hn::Gt(smooth, Splat(0)))});
      });
}

template <bool kMany>
void SampleSpotLight(Wave& wave) {
  if (wave.lights->stretched_spots) return SampleSpots<kMany, true>(wave);
  SampleSpots<kMany, false>(wave);
}

Stage SampleSpotLightStage() {
  return SampleLightStage(
      "light_spot", "connects to spot lights", Feature::kSpotLights,
      ByFeature<Feature::kManyLights, SampleSpotLight<true>, SampleSpotLight<false>>);
}

LANELIGHT_END_KERNELS
