// Closest hit on large spheres, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/shapes-inl.h"
#include "kernels/intersect/stages.h"

LANELIGHT_BEGIN_KERNELS

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
              return alpha ? IntersectShapes<LargeSphereShape, true, true>
                           : IntersectShapes<LargeSphereShape, false, true>;
            }
            return alpha ? IntersectShapes<LargeSphereShape, true, false>
                         : IntersectShapes<LargeSphereShape, false, false>;
          }};
}

Stage ShadowLargeSpheresStage() {
  return {.name = "shadow_large_spheres",
          .meaning = "drop shadow rays blocked by large spheres",
          .input = QueueId::kShadow,
          .needs = {Feature::kLargeSpheres, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = ByFeature<Feature::kAlpha, ShadowShapes<LargeSphereShape, true>,
                               ShadowShapes<LargeSphereShape, false>>};
}

LANELIGHT_END_KERNELS
