// Sub-queues: the part of a queue that one kernel handles.
#ifndef LANELIGHT_QUEUE_FILTER_INL_H_
#define LANELIGHT_QUEUE_FILTER_INL_H_

#include "kernels/queue/batch-inl.h"
#include "src/vocabulary/path/primitive_ranges.h"

LANELIGHT_BEGIN_KERNELS

/// Collects into kScratch, in order, the slots of `queue` for which predicate(slots) is
/// true. Filtering is not counted as occupancy; the loop over the result is.
template <class Predicate>
HWY_INLINE const Queue& FilterQueue(Wave& wave, const Queue& queue,
                                    Predicate&& predicate) {
  const DF df;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(df));
  Queue& scratch = wave.queue(QueueId::kScratch);
  scratch.size = 0;
  LL_DCHECK(HoldsSlots(wave, queue));
  PadTail(queue);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const Slots slots(hn::LoadU(DI(), reinterpret_cast<const int32_t*>(queue.items) + i));
    const MF mine = hn::And(predicate(slots), hn::FirstN(df, queue.size - i));
    if (!hn::AllFalse(df, mine)) Push(scratch, slots, mine);
  }
  return scratch;
}

/// Returns the slots of `queue` whose primitive id lies in [begin, end); the queue itself
/// if the scene has no other primitives.
HWY_INLINE const Queue& FilterPrimitives(Wave& wave, const Queue& queue, uint32_t begin,
                                         uint32_t end) {
  if (begin == 0 && end == wave.ranges->end) return queue;
  const uint32_t* prims = wave.path.prim;
  return FilterQueue(wave, queue, [&](const Slots& slots) HWY_ATTR {
    const DU du;
    const VU prim = hn::BitCast(du, Gather(prims, slots));
    // One comparison: prim - begin wraps around below begin.
    const auto inside =
        hn::Lt(hn::Sub(prim, hn::Set(du, begin)), hn::Set(du, end - begin));
    return hn::RebindMask(DF(), inside);
  });
}

LANELIGHT_END_KERNELS

#endif
