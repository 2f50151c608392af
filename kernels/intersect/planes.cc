// Closest hit on planes, and shadow rays against them.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/planes.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void PlanesWorld(Wave& wave) { IntersectShapes<PlaneShape, false, false>(wave); }
void PlanesWorldAlpha(Wave& wave) { IntersectShapes<PlaneShape, true, false>(wave); }
void PlanesInstances(Wave& wave) { IntersectShapes<PlaneShape, false, true>(wave); }
void PlanesInstancesAlpha(Wave& wave) { IntersectShapes<PlaneShape, true, true>(wave); }
void PlanesShadow(Wave& wave) { ShadowShapes<PlaneShape, false>(wave); }
void PlanesShadowAlpha(Wave& wave) { ShadowShapes<PlaneShape, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(PlanesWorld);
HWY_EXPORT(PlanesWorldAlpha);
HWY_EXPORT(PlanesInstances);
HWY_EXPORT(PlanesInstancesAlpha);
HWY_EXPORT(PlanesShadow);
HWY_EXPORT(PlanesShadowAlpha);

Stage IntersectPlanesStage() {
  return {.name = "intersect_planes",
          .meaning = "closest hit on planes",
          .input = QueueId::kActive,
          .needs = {Feature::kPlanes},
          .reads = ClosestRayFields(),
          .writes = {Field::t, Field::prim, Field::inst},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? HWY_DYNAMIC_DISPATCH(PlanesInstancesAlpha)
                           : HWY_DYNAMIC_DISPATCH(PlanesInstances);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(PlanesWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(PlanesWorld);
          }};
}

Stage ShadowPlanesStage() {
  return {.name = "shadow_planes",
          .meaning = "drop shadow rays blocked by planes",
          .input = QueueId::kShadow,
          .needs = {Feature::kPlanes, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kAlpha) ? HWY_DYNAMIC_DISPATCH(PlanesShadowAlpha)
                                                 : HWY_DYNAMIC_DISPATCH(PlanesShadow);
          }};
}

}  // namespace lanelight
#endif
