// Closest hit on triangles.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/intersect/triangles.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/intersect/few-inl.h"
#include "kernels/intersect/packet-inl.h"
#include "kernels/intersect/single-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

// World triangles, batch by batch: a packet if the rays are coherent, else the plain loop
// if there are few triangles, else ray by ray. Instances are traced ray by ray.
template <bool kAlpha, bool kInstances>
void IntersectTriangles(Wave& wave) {
  const Accel& accel = wave.scene->accel;
  ForEachBatch(wave, wave.queue(QueueId::kActive), [&](VI slots, MF valid) HWY_ATTR {
    const Rays rays = LoadRays(wave.path, slots);
    if constexpr (!kInstances) {
      PacketBounds bounds;
      if (bounds.Compute(rays) && bounds.IsNarrow(accel.groups[0].reach)) {
        return ClosestPacket<kAlpha>(wave, rays, bounds, slots);
      }
      if (!accel.few.triangles.empty()) return ClosestFew<kAlpha>(wave, rays, slots);
    }
    const int count = static_cast<int>(hn::CountTrue(DF(), valid));
    ClosestSingle<kAlpha, kInstances>(wave, rays, slots, count);
  });
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
