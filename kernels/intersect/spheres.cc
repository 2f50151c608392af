// Closest hit on spheres, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/shapes-inl.h"
#include "kernels/intersect/stages.h"

LANELIGHT_BEGIN_KERNELS

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
              return alpha ? IntersectShapes<SphereShape, true, true>
                           : IntersectShapes<SphereShape, false, true>;
            }
            return alpha ? IntersectShapes<SphereShape, true, false>
                         : IntersectShapes<SphereShape, false, false>;
          }};
}

Stage ShadowSpheresStage() {
  return {.name = "shadow_spheres",
          .meaning = "drop shadow rays blocked by spheres",
          .input = QueueId::kShadow,
          .needs = {Feature::kSpheres, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = ByFeature<Feature::kAlpha, ShadowShapes<SphereShape, true>,
                               ShadowShapes<SphereShape, false>>};
}

LANELIGHT_END_KERNELS
