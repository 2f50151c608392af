// Light samples of environments seen through a portal: a point of what the portal shows
// of the map, with density proportional to luminance times solid angle of its texel.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_portal.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/portal-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SamplePortalLight(Wave& wave) {
  const PathColumns& p = wave.path;
  SampleMaps<kMany>(
      wave, LightShape::kPortal, wave.scene->lights.portals, offsetof(LightRecord, image),
      [&](const Portal& map, const StoreSlots& slots) HWY_ATTR {
        return SamplePortal(map, Gather3(p.p_x, p.p_y, p.p_z, slots),
                            Gather(p.u_light_0, slots), Gather(p.u_light_1, slots));
      });
}

void SamplePortalLightOne(Wave& wave) { SamplePortalLight<false>(wave); }
void SamplePortalLightMany(Wave& wave) { SamplePortalLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SamplePortalLightOne);
HWY_EXPORT(SamplePortalLightMany);

Stage SamplePortalLightStage() {
  return SampleLightStage("light_portal", "samples environments through portals",
                          Feature::kPortals, [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SamplePortalLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SamplePortalLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
