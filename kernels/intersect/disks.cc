// Closest hit on disks, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/shapes-inl.h"
#include "kernels/intersect/stages.h"

LANELIGHT_BEGIN_KERNELS

Stage IntersectDisksStage() {
  return {.name = "intersect_disks",
          .meaning = "closest hit on disks",
          .input = QueueId::kActive,
          .needs = {Feature::kDisks},
          .reads = ClosestRayFields(),
          .writes = {Field::t, Field::prim, Field::inst},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? IntersectShapes<DiskShape, true, true>
                           : IntersectShapes<DiskShape, false, true>;
            }
            return alpha ? IntersectShapes<DiskShape, true, false>
                         : IntersectShapes<DiskShape, false, false>;
          }};
}

Stage ShadowDisksStage() {
  return {.name = "shadow_disks",
          .meaning = "drop shadow rays blocked by disks",
          .input = QueueId::kShadow,
          .needs = {Feature::kDisks, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = ByFeature<Feature::kAlpha, ShadowShapes<DiskShape, true>,
                               ShadowShapes<DiskShape, false>>};
}

LANELIGHT_END_KERNELS
