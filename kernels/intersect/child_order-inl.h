// The children of a node that a ray enters, brought in the order in which it visits them.
#ifndef LANELIGHT_INTERSECT_CHILD_ORDER_INL_H_
#define LANELIGHT_INTERSECT_CHILD_ORDER_INL_H_

#include <bit>

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/child_order.h"

LANELIGHT_BEGIN_KERNELS

/// Where compression is a table's work anyway, one table does both.
enum class OrderBy { kCompress, kTableOf8, kTableOf4 };
inline constexpr OrderBy kOrderBy = hn::MaxLanes(D8()) == 4  ? OrderBy::kTableOf4
                                    : HWY_TARGET == HWY_AVX2 ? OrderBy::kTableOf8
                                                             : OrderBy::kCompress;

/// The children that the ray enters no later than it leaves them, those that it visits
/// last first; of targets of 4 lanes, half of them. Behind them anything.
template <OrderBy by>
class ChildOrder;

template <>
class ChildOrder<OrderBy::kTableOf8> {
 public:
  LANELIGHT_INLINE ChildOrder(uint32_t octant, V8 enter, V8 leave) : enter_(enter) {
    const hn::RebindToUnsigned<D8> du;
    const uint32_t set = MaskBits(D8(), hn::Le(enter, leave));
    count_ = static_cast<uint32_t>(std::popcount(set));
    const auto packed = hn::Set(du, kChildOrder8[octant][set]);
    lanes_ = hn::And(hn::Shr(packed, hn::ShiftLeft<2>(hn::Iota(du, 0))), hn::Set(du, 7));
  }
  LANELIGHT_INLINE uint32_t count() const { return count_; }
  LANELIGHT_INLINE V8 entries() const { return InOrder(enter_); }
  LANELIGHT_INLINE V8 InOrder(V8 v) const {
    return hn::TableLookupLanes(v, hn::IndicesFromVec(D8(), lanes_));
  }

 private:
  V8 enter_;
  hn::Vec<hn::RebindToUnsigned<D8>> lanes_;
  uint32_t count_;
};

template <>
class ChildOrder<OrderBy::kTableOf4> {
 public:
  LANELIGHT_INLINE ChildOrder(uint32_t octant, V8 enter, V8 leave) : enter_(enter) {
    const uint32_t set = MaskBits(D8(), hn::Le(enter, leave));
    count_ = static_cast<uint32_t>(std::popcount(set));
    bytes_ = hn::Load(DB(), kChildBytes4[octant & 3][set].byte);
  }
  LANELIGHT_INLINE uint32_t count() const { return count_; }
  LANELIGHT_INLINE V8 entries() const { return InOrder(enter_); }
  LANELIGHT_INLINE V8 InOrder(V8 v) const {
    return hn::BitCast(D8(), hn::TableLookupBytes(hn::BitCast(DB(), v), bytes_));
  }

 private:
  using DB = hn::Repartition<uint8_t, D8>;
  V8 enter_;
  hn::Vec<DB> bytes_;
  uint32_t count_;
};

template <>
class ChildOrder<OrderBy::kCompress> {
 public:
  LANELIGHT_INLINE ChildOrder(uint32_t octant, V8 enter, V8 leave) {
    const D8 d8;
    const hn::RebindToUnsigned<D8> du;
    lanes_ = hn::Xor(hn::Sub(hn::Set(du, kBvhWidth - 1), hn::Iota(du, 0)),
                     hn::Set(du, octant));
    const M8 hit = hn::Le(enter, leave);
    entry_ = Turn(hn::IfThenElse(hit, enter, hn::Set(d8, -1.0f)));
    hit_ = hn::Ge(entry_, hn::Zero(d8));
  }
  LANELIGHT_INLINE uint32_t count() const {
    return static_cast<uint32_t>(hn::CountTrue(D8(), hit_));
  }
  LANELIGHT_INLINE V8 entries() const { return hn::Compress(entry_, hit_); }
  LANELIGHT_INLINE V8 InOrder(V8 v) const { return hn::Compress(Turn(v), hit_); }

 private:
  LANELIGHT_INLINE V8 Turn(V8 v) const {
    return hn::TableLookupLanes(v, hn::IndicesFromVec(D8(), lanes_));
  }

  hn::Vec<hn::RebindToUnsigned<D8>> lanes_;
  V8 entry_;
  M8 hit_;
};

using EnteredChildren = ChildOrder<kOrderBy>;

LANELIGHT_END_KERNELS

#endif
