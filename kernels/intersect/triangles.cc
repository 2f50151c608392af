// Closest hit on triangles.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/triangles.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kAlpha, bool kInstances>
void IntersectTriangles(Wave& wave) {
  if (!kInstances && !wave.scene->accel.few.triangles.empty()) {
    IntersectFew<kAlpha>(wave);
  } else {
    IntersectSingle<kAlpha, kInstances>(wave);
  }
}

void TrianglesWorld(Wave& wave) { IntersectTriangles<false, false>(wave); }
void TrianglesWorldAlpha(Wave& wave) { IntersectTriangles<true, false>(wave); }
void TrianglesInstanced(Wave& wave) { IntersectTriangles<false, true>(wave); }
void TrianglesInstancedAlpha(Wave& wave) { IntersectTriangles<true, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/intersect/stages.h"

namespace lanelight {
HWY_EXPORT(TrianglesWorld);
HWY_EXPORT(TrianglesWorldAlpha);
HWY_EXPORT(TrianglesInstanced);
HWY_EXPORT(TrianglesInstancedAlpha);

Stage IntersectTrianglesStage() {
  return {.name = "intersect_triangles",
          .meaning = "closest hit on triangles",
          .input = QueueId::kActive,
          .needs = {Feature::kTriangles},
          .reads = ClosestRayFields(),
          .writes = fields::kHit,
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? HWY_DYNAMIC_DISPATCH(TrianglesInstancedAlpha)
                           : HWY_DYNAMIC_DISPATCH(TrianglesInstanced);
            }
            return alpha ? HWY_DYNAMIC_DISPATCH(TrianglesWorldAlpha)
                         : HWY_DYNAMIC_DISPATCH(TrianglesWorld);
          }};
}

}  // namespace lanelight
#endif
