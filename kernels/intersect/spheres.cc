// Closest hit on spheres, and shadow rays against them.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/spheres.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void SpheresWorld(Wave& wave) { IntersectShapes<SphereShape, false, false>(wave); }
void SpheresWorldAlpha(Wave& wave) { IntersectShapes<SphereShape, true, false>(wave); }
void SpheresInstances(Wave& wave) { IntersectShapes<SphereShape, false, true>(wave); }
void SpheresInstancesAlpha(Wave& wave) { IntersectShapes<SphereShape, true, true>(wave); }
void SpheresShadow(Wave& wave) { ShadowShapes<SphereShape, false>(wave); }
void SpheresShadowAlpha(Wave& wave) { ShadowShapes<SphereShape, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(SpheresWorld);
HWY_EXPORT(SpheresWorldAlpha);
HWY_EXPORT(SpheresInstances);
HWY_EXPORT(SpheresInstancesAlpha);
HWY_EXPORT(SpheresShadow);
HWY_EXPORT(SpheresShadowAlpha);

Stage IntersectSpheresStage() {
  return {.name = "intersect_spheres",
          .meaning = "closest hit on spheres",
          .input = QueueId::kActive,
          .needs = {Feature::kSpheres},
          .reads = ClosestRayFields(),
          .writes = {Field::t, Field::prim, Field::inst},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? HWY_DYNAMIC_DISPATCH(SpheresInstancesAlpha)
                           : HWY_DYNAMIC_DISPATCH(SpheresInstances);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(SpheresWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(SpheresWorld);
          }};
}

Stage ShadowSpheresStage() {
  return {.name = "shadow_spheres",
          .meaning = "drop shadow rays blocked by spheres",
          .input = QueueId::kShadow,
          .needs = {Feature::kSpheres, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kAlpha)
                       ? HWY_DYNAMIC_DISPATCH(SpheresShadowAlpha)
                       : HWY_DYNAMIC_DISPATCH(SpheresShadow);
          }};
}

}  // namespace lanelight
#endif
