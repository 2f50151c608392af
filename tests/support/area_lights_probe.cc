#include "kernels/simd/each_target-inl.h"

#include "kernels/control/area_lights-inl.h"
#include "tests/support/area_lights_probe.h"

LANELIGHT_BEGIN_KERNELS

void AreaLightsProbe(const IrradianceBatch& batch) {
  const DF df;
  const auto load = [&](const float* const* a, uint32_t i) HWY_ATTR {
    return V3{hn::LoadU(df, a[0] + i), hn::LoadU(df, a[1] + i), hn::LoadU(df, a[2] + i)};
  };
  const auto store = [&](V3 v, float* const* a, uint32_t i) HWY_ATTR {
    hn::StoreU(v.x, df, a[0] + i);
    hn::StoreU(v.y, df, a[1] + i);
    hn::StoreU(v.z, df, a[2] + i);
  };
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(df));
  for (uint32_t i = 0; i < batch.n; i += lanes) {
    const AreaLight light = AreaLightsAt<true>(
        *batch.scene, {load(batch.p, i), Splat(0), load(batch.normal, i)}, hn::Zero(DI()),
        [](VI, V3 radiance) HWY_ATTR { return radiance; });
    store(light.above, batch.above, i);
    store(light.below, batch.below, i);
    hn::StoreU(hn::IfThenElseZero(light.selected, Splat(1.0f)), df, batch.takes_part + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(AreaLightsProbe);

void ProbeAreaLights(SimdTarget target, const IrradianceBatch& batch) {
  LANELIGHT_ON(target, AreaLightsProbe)(batch);
}

}  // namespace lanelight
#endif  // HWY_ONCE
