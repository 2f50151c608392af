// Light samples of environments seen through a portal: a point of what the portal shows
// of the map, with density proportional to luminance times solid angle of its texel.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/portal-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SamplePortalLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const std::vector<Portal>& portals = wave.lights->portals;
  SampleMaps<kMany>(
      wave, LightShape::kPortal, portals.size(), offsetof(LightRecord, image),
      [&](std::size_t map, const StoreSlots& slots) HWY_ATTR {
        return SamplePortal(portals[map], Gather3(p.p_x, p.p_y, p.p_z, slots),
                            Gather(p.u_light_0, slots), Gather(p.u_light_1, slots));
      });
}

Stage SamplePortalLightStage() {
  return SampleLightStage(
      "light_portal", "samples environments through portals", Feature::kPortals,
      ByFeature<Feature::kManyLights, SamplePortalLight<true>, SamplePortalLight<false>>);
}

LANELIGHT_END_KERNELS
