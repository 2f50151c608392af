// Sub-queues: the part of a queue that one kernel handles.
#if defined(LANELIGHT_QUEUE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_QUEUE_FILTER_INL_H_
#undef LANELIGHT_QUEUE_FILTER_INL_H_
#else
#define LANELIGHT_QUEUE_FILTER_INL_H_
#endif

#include "kernels/queue/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Collects into kScratch, in order, the slots of `queue` for which predicate(slots) is
/// true. Filtering is not counted as occupancy; the loop over the result is.
template <class Predicate>
HWY_INLINE const Queue& FilterQueue(Wave& wave, const Queue& queue,
                                    Predicate&& predicate) {
  const DF df;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(df));
  Queue& scratch = wave.queue(QueueId::kScratch);
  scratch.size = 0;
  PadTail(queue);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const VI slots = hn::LoadU(DI(), reinterpret_cast<const int32_t*>(queue.items) + i);
    Push(scratch, slots, hn::And(predicate(slots), hn::FirstN(df, queue.size - i)));
  }
  return scratch;
}

/// Filters primitives with ids in [begin, end).
HWY_INLINE const Queue& FilterPrimitives(Wave& wave, const Queue& queue, uint32_t begin,
                                         uint32_t end) {
  const uint32_t* prims = wave.path.prim;
  // Highway 1.0 compares integers with Lt and Gt only.
  const VI before = hn::Set(DI(), static_cast<int32_t>(begin) - 1);
  const VI after = hn::Set(DI(), static_cast<int32_t>(end));
  return FilterQueue(wave, queue, [&](VI slots) HWY_ATTR {
    const VI prim = Gather(prims, slots);
    return hn::RebindMask(DF(), hn::And(hn::Gt(prim, before), hn::Lt(prim, after)));
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
