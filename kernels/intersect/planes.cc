// Closest hit on planes, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/shapes-inl.h"
#include "kernels/intersect/stages.h"

LANELIGHT_BEGIN_KERNELS

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
              return alpha ? IntersectShapes<PlaneShape, true, true>
                           : IntersectShapes<PlaneShape, false, true>;
            }
            return alpha ? IntersectShapes<PlaneShape, true, false>
                         : IntersectShapes<PlaneShape, false, false>;
          }};
}

Stage ShadowPlanesStage() {
  return {.name = "shadow_planes",
          .meaning = "drop shadow rays blocked by planes",
          .input = QueueId::kShadow,
          .needs = {Feature::kPlanes, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = ByFeature<Feature::kAlpha, ShadowShapes<PlaneShape, true>,
                               ShadowShapes<PlaneShape, false>>};
}

LANELIGHT_END_KERNELS
