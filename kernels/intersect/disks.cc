// Closest hit on disks, and shadow rays against them.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/disks.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void DisksWorld(Wave& wave) { IntersectShapes<DiskShape, false, false>(wave); }
void DisksWorldAlpha(Wave& wave) { IntersectShapes<DiskShape, true, false>(wave); }
void DisksInstances(Wave& wave) { IntersectShapes<DiskShape, false, true>(wave); }
void DisksInstancesAlpha(Wave& wave) { IntersectShapes<DiskShape, true, true>(wave); }
void DisksShadow(Wave& wave) { ShadowShapes<DiskShape, false>(wave); }
void DisksShadowAlpha(Wave& wave) { ShadowShapes<DiskShape, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(DisksWorld);
HWY_EXPORT(DisksWorldAlpha);
HWY_EXPORT(DisksInstances);
HWY_EXPORT(DisksInstancesAlpha);
HWY_EXPORT(DisksShadow);
HWY_EXPORT(DisksShadowAlpha);

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
              return alpha ? HWY_DYNAMIC_DISPATCH(DisksInstancesAlpha)
                           : HWY_DYNAMIC_DISPATCH(DisksInstances);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(DisksWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(DisksWorld);
          }};
}

Stage ShadowDisksStage() {
  return {.name = "shadow_disks",
          .meaning = "drop shadow rays blocked by disks",
          .input = QueueId::kShadow,
          .needs = {Feature::kDisks, Feature::kLights, Feature::kOpaqueShadows},
          .reads = ShadowRayFields(),
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kAlpha) ? HWY_DYNAMIC_DISPATCH(DisksShadowAlpha)
                                                 : HWY_DYNAMIC_DISPATCH(DisksShadow);
          }};
}

}  // namespace lanelight
#endif
