// Sorts intersected paths into those that hit something and those that left the scene.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/primitive_ranges.h"

LANELIGHT_BEGIN_KERNELS

// Returns whether the hit is ahead of the ray and a primitive of the scene.
HWY_INLINE MF IsHit(const Wave& wave, const Slots& slots) {
  const VI prim = Gather(wave.path.prim, slots);
  const VI end = hn::Set(DI(), static_cast<int32_t>(wave.ranges->end));
  const auto known = hn::AndNot(hn::Lt(prim, hn::Zero(DI())), hn::Lt(prim, end));
  return hn::And(hn::Ge(Gather(wave.path.t, slots), hn::Zero(DF())),
                 hn::RebindMask(DF(), known));
}

template <bool kEnvironment>
void Split(Wave& wave) {
  const Queue& active = wave.queue(QueueId::kActive);
  wave.rays_closest += active.size;
  ForEachBatch(wave, active, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF hit =
        hn::Lt(Gather(wave.path.t, slots), Splat(std::numeric_limits<float>::infinity()));
    LL_DCHECK(AllUnder(hit, IsHit(wave, slots)));
    Push(wave.queue(QueueId::kHit), slots, hn::And(valid, hit));
    const MF miss = hn::AndNot(hit, valid);
    if constexpr (kEnvironment) Push(wave.queue(QueueId::kMiss), slots, miss);
    // A path ends here whether or not the escape stage still adds to it.
    Push(wave.queue(QueueId::kDone), slots, miss);
  });
}

Stage HitsStage() {
  return {.name = "hits",
          .meaning = "sorts paths into hits and misses",
          .input = QueueId::kActive,
          .role = StageRole::kSort,
          .reads = {Field::t},
          .resolve = ByFeature<Feature::kInfiniteLights, Split<true>, Split<false>>};
}

LANELIGHT_END_KERNELS
