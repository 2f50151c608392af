// Lists of the stream's rays by their next step, rebuilt in each round.
#ifndef LANELIGHT_INTERSECT_STREAM_LISTS_INL_H_
#define LANELIGHT_INTERSECT_STREAM_LISTS_INL_H_

#include <type_traits>

#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Rays that take a step together, in one straight run of instructions.
inline constexpr uint32_t kInterleavedRays = 2;

/// Places of rays, with room for a vector stored past the last one.
struct RayList {
  uint32_t size = 0;
  int32_t place[StreamRays::kRoom];

  template <class M>
  LANELIGHT_INLINE void Append(VI rays, M mask) {
    hn::StoreU(hn::Compress(rays, mask), DI(), place + size);
    size += static_cast<uint32_t>(hn::CountTrue(DI(), mask));
  }
  /// Fills the last group up with its last ray, whose step is then done twice.
  LANELIGHT_INLINE void PadGroup() {
    for (uint32_t j = 0; size > 0 && j < kInterleavedRays; ++j)
      place[size + j] = place[size - 1];
  }
};

template <bool kInstances>
struct RayLists {
  RayList live;              // rays that are not at their end
  RayList nodes;             // those at a node, ...
  RayList leaves, separate;  // ... at either kind of leaf, ...
  // ... at an instance, at the way back from one
  std::conditional_t<kInstances, RayList, char> entering, leaving;

  /// Lists the live rays anew by what is next. Apart from the steps, which thus store
  /// only to places known beforehand: a store to a place that depends on the outcome of a
  /// step would hold up the loads of the steps that follow.
  LANELIGHT_INLINE void Classify(const StreamRays& rays) {
    const DI di;
    const uint32_t n = live.size;
    live.size = nodes.size = leaves.size = separate.size = 0;
    if constexpr (kInstances) entering.size = leaving.size = 0;
    for (uint32_t i = 0; i < n; i += hn::MaxLanes(di)) {
      const auto valid = hn::FirstN(di, n - i);
      const VI place = hn::IfThenElseZero(valid, hn::LoadU(di, live.place + i));
      const VI next = Gather(rays.next, place);
      const auto alive = hn::And(valid, hn::Ne(next, hn::Set(di, -1)));
      const auto negative = hn::Lt(next, hn::Zero(di));
      auto leaf = hn::And(alive, negative);
      if constexpr (kInstances) leaf = ListMoving(rays, place, next, leaf);
      nodes.Append(place, hn::AndNot(negative, alive));
      const auto apart = hn::And(leaf, hn::Lt(hn::ShiftLeft<1>(next), hn::Zero(di)));
      leaves.Append(place, hn::AndNot(apart, leaf));
      separate.Append(place, apart);
      live.Append(place, alive);
    }
  }

 private:
  // Lists the rays that are at an instance, or at its end; returns the others of `leaf`.
  template <class M>
  LANELIGHT_INLINE M ListMoving(const StreamRays& rays, VI place, VI next, M leaf) {
    const DI di;
    const auto is = [&](VI v, uint32_t ref)
                        HWY_ATTR { return hn::Eq(v, hn::Set(di, int32_t(ref))); };
    const VI space = Gather(reinterpret_cast<const int32_t*>(rays.space), place);
    // Clang 19 never finishes with the union of `leaves` and what enters on SSE4.
    const M changes = hn::And(leaf, hn::Or(is(next, kReturnRef), is(space, kTopSpace)));
    const M leaves = hn::And(leaf, is(next, kReturnRef));
    leaving.Append(place, leaves);
    entering.Append(place, hn::AndNot(leaves, changes));
    return hn::AndNot(changes, leaf);
  }
};

LANELIGHT_END_KERNELS

#endif
