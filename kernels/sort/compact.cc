// Compacts the paths that continue into the first slots, in order. The next wave then
// reads its columns by whole vectors (slots-inl.h), and new paths start in neighbouring
// slots. Random numbers and sums of a path do not depend on its slot.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// Returns one past the highest slot of the queue; 0 if it is empty.
HWY_INLINE uint32_t EndOf(const Queue& queue) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  if (queue.size == 0) return 0;
  VU highest = hn::Zero(du);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    highest = hn::Max(highest, hn::LoadU(du, queue.items + i));  // padded
  }
  return hn::GetLane(hn::MaxOfLanes(du, highest)) + 1;
}

// Marks the slots of `queue` by 1, the others below `end` and one vector more by 0.
HWY_INLINE void Mark(const Queue& queue, uint32_t end, uint32_t* marks) {
  const DI di;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(di));
  int32_t* out = reinterpret_cast<int32_t*>(marks);
  for (uint32_t i = 0; i < end; i += lanes) hn::StoreU(hn::Zero(di), di, out + i);
  const int32_t* slots = reinterpret_cast<const int32_t*>(queue.items);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    Scatter(hn::Set(di, 1), out, Slots(hn::LoadU(di, slots + i)));
  }
}

// Closes the gaps between marked slots in a column, a vector of slots at a time: what is
// written has been read, because nothing moves up.
HWY_INLINE void CloseGaps(uint32_t* column, const uint32_t* marks, uint32_t end) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  uint32_t* to = column;
  for (uint32_t from = 0; from < end; from += lanes) {
    const auto live = hn::Ne(hn::LoadU(du, marks + from), hn::Zero(du));
    hn::StoreU(hn::Compress(hn::LoadU(du, column + from), live), du, to);
    to += hn::CountTrue(du, live);
  }
}

void Compact(Wave& wave) {
  const DU du;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(du));
  Queue& live = wave.queue(QueueId::kScattered);
  Queue& free = wave.queue(QueueId::kFree);
  PadTail(live);
  LL_DCHECK(HoldsSlots(wave, live));
  const uint32_t end = EndOf(live);
  uint32_t* marks = wave.queue(QueueId::kScratch).items;
  Mark(live, end, marks);
  const ColumnList& carried = wave.lists.carried;
  for (uint32_t c = 0; c < carried.count; ++c) CloseGaps(carried.columns[c], marks, end);
  for (uint32_t i = 0; i < live.size; i += lanes) {
    hn::StoreU(hn::Iota(du, i), du, live.items + i);
  }
  // A stack: the lowest slot is taken first.
  free.size = wave.capacity - live.size;
  const VU top = hn::Set(du, wave.capacity - 1);
  for (uint32_t i = 0; i < free.size; i += lanes) {
    hn::StoreU(hn::Sub(top, hn::Iota(du, i)), du, free.items + i);
  }
  CountBatches(wave, live);
}

Stage CompactStage() {
  return {.name = "compact",
          .meaning = "moves surviving paths into the first slots",
          .input = QueueId::kDone,
          .role = StageRole::kSort,
          .reads = fields::EverCarried(),
          .writes = fields::EverCarried(),
          .resolve = Always<Compact>};
}

LANELIGHT_END_KERNELS
