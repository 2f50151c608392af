// The hits of one shape set among the queue of surface hits.
#if defined(LANELIGHT_SURFACE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_SURFACE_FILTER_INL_H_
#undef LANELIGHT_SURFACE_FILTER_INL_H_
#else
#define LANELIGHT_SURFACE_FILTER_INL_H_
#endif

#include "kernels/queue/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The slots of kSurface whose primitive id lies in [begin, end), in order. They are
/// gathered in kScratch, or are kSurface itself if the scene has no other primitives.
HWY_INLINE Queue FilterQueue(Wave& wave, uint32_t begin, uint32_t end) {
  const Queue& hits = wave.queue(QueueId::kSurface);
  if (begin == 0 && end == wave.scene->geometry.ranges.end) return hits;
  Queue& kept = wave.queue(QueueId::kScratch);
  kept.size = 0;
  const LaneCounters counters = wave.lanes;  // filtering is not the work to count
  ForEachBatch(wave, hits, [&](VI slots, MF valid) HWY_ATTR {
    const DU du;
    const VU prim = hn::BitCast(du, Gather(wave.path.prim, slots));
    // One comparison: prim - begin wraps around below begin.
    const auto inside =
        hn::Lt(hn::Sub(prim, hn::Set(du, begin)), hn::Set(du, end - begin));
    Push(kept, slots, hn::And(valid, hn::RebindMask(DF(), inside)));
  });
  wave.lanes = counters;
  return kept;
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
