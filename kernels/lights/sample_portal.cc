// Light samples of environments seen through a portal: a point of what the portal shows
// of the map, with density proportional to luminance times solid angle of its texel.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_portal.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/portal-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SamplePortalLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  for (std::size_t e = 0; e < scene.lights.portals.size(); ++e) {
    const Portal& portal = scene.lights.portals[e];
    ForEachLit<kMany>(
        wave, LightShape::kPortal, [&](const StoreSlots& slots, VI index) HWY_ATTR {
          const Lights light(scene, index);
          const MF mine =
              hn::RebindMask(DF(), hn::Eq(light.I(offsetof(LightRecord, image)),
                                          hn::Set(DI(), static_cast<int32_t>(e))));
          if (hn::AllFalse(DF(), mine)) return;
          const PortalSample s =
              SamplePortal(portal, Gather3(p.p_x, p.p_y, p.p_z, slots),
                           Gather(p.u_light_0, slots), Gather(p.u_light_1, slots));
          const VF pdf = hn::Mul(light.Pmf(p, slots), s.pdf_sa);
          const V3 value = Mul(s.radiance, hn::Div(Splat(1.0f), pdf));
          const V3 usable = IfThenElseZero(hn::Gt(pdf, Splat(0)), value);
          const auto keep = [&](VF v, float* column) HWY_ATTR {
            Scatter(hn::IfThenElse(mine, v, Gather(column, slots)), column, slots);
          };
          keep(s.direction.x, p.ls_x);
          keep(s.direction.y, p.ls_y);
          keep(s.direction.z, p.ls_z);
          keep(Splat(std::numeric_limits<float>::infinity()), p.ls_distance);
          keep(usable.x, p.ls_r);
          keep(usable.y, p.ls_g);
          keep(usable.z, p.ls_b);
          keep(pdf, p.ls_pdf);
        });
  }
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
