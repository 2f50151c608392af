// Sorts intersected paths into those that hit something and those that left the scene.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/sort/split.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kEnvironment>
void Split(Wave& wave) {
  const Queue& active = wave.queue(QueueId::kActive);
  wave.rays_closest += active.size;
  ForEachBatch(wave, active, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF hit =
        hn::Lt(Gather(wave.path.t, slots), Splat(std::numeric_limits<float>::infinity()));
    Push(wave.queue(QueueId::kHit), slots, hn::And(valid, hit));
    const MF miss = hn::AndNot(hit, valid);
    if constexpr (kEnvironment) Push(wave.queue(QueueId::kMiss), slots, miss);
    // A path ends here whether or not the escape stage still adds to it.
    Push(wave.queue(QueueId::kDone), slots, miss);
  });
}

void SplitOpen(Wave& wave) { Split<true>(wave); }
void SplitClosed(Wave& wave) { Split<false>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(SplitOpen);
HWY_EXPORT(SplitClosed);

Stage SplitStage() {
  return {.name = "split",
          .meaning = "sorts paths into hits and misses",
          .input = QueueId::kActive,
          .reads = {Field::t},
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kInfiniteLights)
                       ? HWY_DYNAMIC_DISPATCH(SplitOpen)
                       : HWY_DYNAMIC_DISPATCH(SplitClosed);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
