// Access to the columns of a batch of paths.
//
// Slots of a batch are often neighbours: the compact stage (kernels/sort/compact.cc)
// starts every wave without gaps, and queues keep their order. Gathers and scatters cost
// about a cycle per lane wherever the lanes are, so neighbours are reached by whole
// vectors:
//   run      slots first, first + 1, ...: one load or store
//   window   all slots in two adjacent aligned blocks: two loads and permutations
//   anywhere gather and scatter
#ifndef LANELIGHT_QUEUE_SLOTS_INL_H_
#define LANELIGHT_QUEUE_SLOTS_INL_H_

#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The slots of one batch. Converts to their vector.
struct Slots {
  enum class Layout : uint32_t { kRun, kWindow, kAnywhere };

  VI index;
  Layout layout = Layout::kAnywhere;
  uint32_t first;  // run: the first slot; window: where its blocks begin
  VI lane;         // window: of each slot, within its block
  MF upper;        // window: the slot is in the second block

  LANELIGHT_INLINE explicit Slots(VI slots)
      : index(slots), first(static_cast<uint32_t>(hn::GetLane(slots))) {
    const DI di;
    const int32_t lanes = static_cast<int32_t>(hn::Lanes(di));
    if (hn::AllTrue(di, hn::Eq(index, hn::Iota(di, static_cast<int32_t>(first))))) {
      layout = Layout::kRun;
    } else if (kWindows) {
      const uint32_t begin = first & ~(static_cast<uint32_t>(lanes) - 1);
      const VI at = hn::Sub(index, hn::Set(di, static_cast<int32_t>(begin)));
      const VI low = hn::And(at, hn::Set(di, lanes - 1));
      const VI block = hn::Sub(at, low);
      const VI second = hn::Set(di, lanes);
      const auto is_second = hn::Eq(block, second);
      lane = low;
      upper = hn::RebindMask(DF(), is_second);
      if (hn::AllTrue(di, hn::Or(is_second, hn::Eq(block, hn::Zero(di))))) {
        layout = Layout::kWindow;
        first = begin;
      }
    }
  }
  HWY_INLINE operator VI() const { return index; }  // NOLINT: used like one
};

LANELIGHT_INLINE VF Gather(const float* column, const Slots& slots) {
  const DF df;
  if (HWY_LIKELY(slots.layout == Slots::Layout::kRun)) {
    return hn::LoadU(df, column + slots.first);
  }
  if (kWindows && slots.layout == Slots::Layout::kWindow) {
    const float* low = column + slots.first;
    const auto lane = hn::IndicesFromVec(df, slots.lane);
    return hn::IfThenElse(slots.upper,
                          hn::TableLookupLanes(hn::LoadU(df, low + hn::Lanes(df)), lane),
                          hn::TableLookupLanes(hn::LoadU(df, low), lane));
  }
  return hn::GatherIndex(df, column, slots.index);
}
LANELIGHT_INLINE VI Gather(const int32_t* column, const Slots& slots) {
  return hn::BitCast(DI(), Gather(reinterpret_cast<const float*>(column), slots));
}
LANELIGHT_INLINE VI Gather(const uint32_t* column, const Slots& slots) {
  return hn::BitCast(DI(), Gather(reinterpret_cast<const float*>(column), slots));
}

/// For stages that write several columns: has the inverse of the permutation.
struct StoreSlots : Slots {
  VI from[2];  // window: lane that goes to each place of the two blocks
  MF has[2];   // and whether there is one

  LANELIGHT_INLINE StoreSlots(const Slots& slots)  // NOLINT: a lambda may ask for either
      : Slots(slots) {
    if (!kWindows || layout != Layout::kWindow) return;
    const DI di;
    const int32_t lanes = static_cast<int32_t>(hn::Lanes(di));
    HWY_ALIGN int32_t inverse[2 * hn::MaxLanes(DI())];
    const VI none = hn::Set(di, -1);
    hn::Store(none, di, inverse);
    hn::Store(none, di, inverse + lanes);
    const VI begin = hn::Set(di, static_cast<int32_t>(first));
    hn::ScatterIndex(hn::Iota(di, 0), di, inverse, hn::Sub(index, begin));
    for (int block = 0; block < 2; ++block) {
      const VI source = hn::Load(di, inverse + block * lanes);
      has[block] = hn::RebindMask(DF(), hn::Gt(source, none));
      from[block] = hn::Max(source, hn::Zero(di));
    }
  }
};

LANELIGHT_INLINE void Scatter(VF v, float* column, const Slots& slots) {
  if (HWY_LIKELY(slots.layout == Slots::Layout::kRun)) {
    hn::StoreU(v, DF(), column + slots.first);
  } else {
    hn::ScatterIndex(v, DF(), column, slots.index);
  }
}
LANELIGHT_INLINE void Scatter(VF v, float* column, const StoreSlots& slots) {
  const DF df;
  if (HWY_LIKELY(slots.layout == Slots::Layout::kRun)) {
    hn::StoreU(v, df, column + slots.first);
  } else if (kWindows && slots.layout == Slots::Layout::kWindow) {
    for (int block = 0; block < 2; ++block) {
      const auto from = hn::IndicesFromVec(df, slots.from[block]);
      hn::BlendedStore(hn::TableLookupLanes(v, from), slots.has[block], df,
                       column + slots.first + block * hn::Lanes(df));
    }
  } else {
    hn::ScatterIndex(v, df, column, slots.index);
  }
}
template <class S>
LANELIGHT_INLINE void Scatter(VI v, int32_t* column, const S& slots) {
  Scatter(hn::BitCast(DF(), v), reinterpret_cast<float*>(column), slots);
}
template <class S>
LANELIGHT_INLINE void Scatter(VI v, uint32_t* column, const S& slots) {
  Scatter(hn::BitCast(DF(), v), reinterpret_cast<float*>(column), slots);
}

LANELIGHT_END_KERNELS

#endif
