// Closest hit on large spheres, and shadow rays against them.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/large_spheres.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void LargeSpheresWorld(Wave& wave) {
  IntersectShapes<LargeSphereShape, false, false>(wave);
}
void LargeSpheresWorldAlpha(Wave& wave) {
  IntersectShapes<LargeSphereShape, true, false>(wave);
}
void LargeSpheresInstances(Wave& wave) {
  IntersectShapes<LargeSphereShape, false, true>(wave);
}
void LargeSpheresInstancesAlpha(Wave& wave) {
  IntersectShapes<LargeSphereShape, true, true>(wave);
}
void LargeSpheresShadow(Wave& wave) { ShadowShapes<LargeSphereShape, false>(wave); }
void LargeSpheresShadowAlpha(Wave& wave) { ShadowShapes<LargeSphereShape, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(LargeSpheresWorld);
HWY_EXPORT(LargeSpheresWorldAlpha);
HWY_EXPORT(LargeSpheresInstances);
HWY_EXPORT(LargeSpheresInstancesAlpha);
HWY_EXPORT(LargeSpheresShadow);
HWY_EXPORT(LargeSpheresShadowAlpha);

Stage IntersectLargeSpheresStage() {
  return {.name = "intersect_large_spheres",
          .meaning = "closest hit on large spheres",
          .input = QueueId::kActive,
          .needs = {Feature::kLargeSpheres},
          .reads = ClosestRayFields(),
          .writes = {Field::t, Field::prim, Field::inst},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? HWY_DYNAMIC_DISPATCH(LargeSpheresInstancesAlpha)
                           : HWY_DYNAMIC_DISPATCH(LargeSpheresInstances);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(LargeSpheresWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(LargeSpheresWorld);
          }};
}

Stage ShadowLargeSpheresStage() {
  return {.name = "shadow_large_spheres",
          .meaning = "drop shadow rays blocked by large spheres",
          .input = QueueId::kShadow,
          .needs = {Feature::kLargeSpheres, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kAlpha)
                       ? HWY_DYNAMIC_DISPATCH(LargeSpheresShadowAlpha)
                       : HWY_DYNAMIC_DISPATCH(LargeSpheresShadow);
          }};
}

}  // namespace lanelight
#endif
