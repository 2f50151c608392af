// Loops over a queue of path slots, a vector at a time; sub-queues; keys of random
// numbers.
#ifndef LANELIGHT_QUEUE_BATCH_INL_H_
#define LANELIGHT_QUEUE_BATCH_INL_H_

#include <algorithm>

#include "kernels/queue/slots-inl.h"
#include "src/base/core/check.h"
#include "src/vocabulary/path/dimensions.h"
#include "src/vocabulary/path/fields.h"
#include "src/vocabulary/path/scene_parts.h"
#include "src/vocabulary/path/stage.h"

LANELIGHT_BEGIN_KERNELS

/// Repeats the last slot over one vector past the end. A batch that runs past the end
/// then recomputes that path: every store of a kernel is a function of the slot alone,
/// so the repeated lanes store the same values and no masking is needed.
LANELIGHT_INLINE void PadTail(const Queue& queue) {
  if (queue.size == 0) return;
  const DU du;
  hn::StoreU(hn::Set(du, queue.items[queue.size - 1]), du, queue.items + queue.size);
}

/// Adds one pass over the queue to the occupancy of the running stage.
HWY_INLINE void CountBatches(Wave& wave, const Queue& queue) {
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  wave.lanes.items += queue.size;
  wave.lanes.vectors += (queue.size + lanes - 1) / lanes;
}

/// Returns whether the condition holds in all lanes under `mask`, for LL_DCHECK.
HWY_INLINE bool AllUnder(MF mask, MF condition) {
  return hn::AllFalse(DF(), hn::AndNot(condition, mask));
}

/// Returns whether the queue has no more than all slots, each of them one of the wave's.
HWY_INLINE bool HoldsSlots(const Wave& wave, const Queue& queue) {
  return queue.size <= wave.capacity &&
         std::all_of(queue.items, queue.items + queue.size,
                     [&](uint32_t slot) { return slot < wave.capacity; });
}

/// Calls body(const Slots& slots, MF valid) for each vector of the queue. `valid` marks
/// the lanes before the end (only pushes to other queues and counts need it). Counts
/// occupancy.
template <class Body>
HWY_INLINE void ForEachBatch(Wave& wave, const Queue& queue, Body&& body) {
  const DF df;
  const DI di;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(df));
  LL_DCHECK(HoldsSlots(wave, queue));
  PadTail(queue);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const VI slots = hn::LoadU(di, reinterpret_cast<const int32_t*>(queue.items) + i);
    body(Slots(slots), hn::FirstN(df, queue.size - i));
  }
  CountBatches(wave, queue);
}

/// Appends the slots under `mask` to `queue`.
LANELIGHT_INLINE void Push(Queue& queue, VI slots, MF mask) {
  const DI di;
  // Not CompressStore, whose instruction is microcoded on some processors. What is
  // written beyond the end lies within the padding, or has been read where a queue is
  // compacted in place.
  const VI packed = hn::Compress(slots, hn::RebindMask(di, mask));
  hn::StoreU(packed, di, reinterpret_cast<int32_t*>(queue.items) + queue.size);
  queue.size += static_cast<uint32_t>(hn::CountTrue(DF(), mask));
}

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

/// Returns the key of dimension 0 at a depth.
HWY_INLINE VU FirstKey(VU depth) { return hn::ShiftLeft<kDepthShift>(depth); }

/// Returns the key of dimension 0 at a depth, for split paths too.
HWY_INLINE VU FirstKey(const PathColumns& p, VU depth, const Slots& slots) {
  if (p.branch == nullptr) return FirstKey(depth);
  const VU branch = hn::BitCast(DU(), Gather(p.branch, slots));
  return hn::Or(FirstKey(depth), hn::ShiftLeft<kBranchShift>(branch));
}

/// Returns the key of a dimension; `offset` lies within the range of its purpose.
HWY_INLINE VU KeyOf(const PathColumns& p, Dimension dimension, VU depth,
                    const Slots& slots, uint32_t offset = 0) {
  const uint32_t place = static_cast<uint32_t>(dimension) + offset;
  return hn::Add(FirstKey(p, depth, slots), hn::Set(DU(), place));
}

LANELIGHT_END_KERNELS

#endif
