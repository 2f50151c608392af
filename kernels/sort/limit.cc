// Ends paths that have used up their scattering events; the others go on to the surface
// stages. As in pbrt, a path of maximum depth D sees emission after D events.
#include "kernels/simd/each_target-inl.h"

#include <utility>

#include "kernels/queue/depth-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

// Where paths go through interfaces of media, stage `interfaces` ends the others.
template <bool kInterfaces>
void LimitDepth(Wave& wave) {
  if constexpr (kInterfaces) {
    std::swap(wave.queue(QueueId::kHit), wave.queue(QueueId::kSurface));
    wave.queue(QueueId::kHit).size = 0;
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
      .reads = {Field::depth, Field::medium, Field::walked},
      .resolve = ByFeature<Feature::kInterfaces, LimitDepth<true>, LimitDepth<false>>};
}

LANELIGHT_END_KERNELS
