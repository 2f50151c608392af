// Ends paths that have used up their scattering events; the others go on to the surface
// stages. As in pbrt, a path of maximum depth D sees emission after D events.
#include "kernels/simd/each_target-inl.h"

#include <algorithm>

#include "kernels/queue/depth-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

// Where paths go through interfaces of media, all go on: stage `interfaces` ends those
// that meet another surface.
template <bool kInterfaces>
void LimitDepth(Wave& wave) {
  if constexpr (kInterfaces) {
    const Queue& hits = wave.queue(QueueId::kHit);
    Queue& surfaces = wave.queue(QueueId::kSurface);
    std::copy_n(hits.items, hits.size, surfaces.items);
    surfaces.size = hits.size;
    return;
  }
  ForEachBatch(wave, wave.queue(QueueId::kHit),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 const MF below = MayScatter(wave, slots);
                 Push(wave.queue(QueueId::kSurface), slots, hn::And(valid, below));
                 Push(wave.queue(QueueId::kDone), slots, hn::AndNot(below, valid));
               });
}

Stage LimitStage() {
  return {
      .name = "limit",
      .meaning = "ends paths at the maximum depth",
      .input = QueueId::kHit,
      .role = StageRole::kSort,
      .reads = {Field::depth, Field::medium, Field::walked},
      .resolve = ByFeature<Feature::kInterfaces, LimitDepth<true>, LimitDepth<false>>};
}

LANELIGHT_END_KERNELS
