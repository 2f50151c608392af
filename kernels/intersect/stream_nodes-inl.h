// Nodes in the first phase of a stream: each ray of a packet has its own slab test.
#ifndef LANELIGHT_INTERSECT_STREAM_NODES_INL_H_
#define LANELIGHT_INTERSECT_STREAM_NODES_INL_H_

#include <bit>

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/stream_rays-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The children of a node that the packet is in, in the order in which its
/// first ray visits them: which lanes enter, and at what distances, unless any hit ends
/// a ray.
struct PacketFrame {
  HWY_ALIGN float entry[kBvhWidth][StreamRays::kLanes];
  uint32_t ref[kBvhWidth], lanes[kBvhWidth];
  uint32_t open;  // children to visit, as bits

  /// A frame whose only child is the root.
  LANELIGHT_INLINE void SetRoot(uint32_t root, uint32_t rays) {
    const DF df;
    hn::Store(hn::Zero(df), df, entry[0]);
    ref[0] = root;
    lanes[0] = rays;
    open = root != kEmptyRef;
  }

  /// Goes up to a frame with children to visit; false if there is none.
  static LANELIGHT_INLINE bool Next(const PacketFrame* first, PacketFrame*& frame) {
    while (frame->open == 0) {
      if (frame == first) return false;
      --frame;
    }
    return true;
  }

  /// Fills the frame of a node for the rays of `rays`, the first of which is in `octant`.
  /// Every child is tested, and everything is stored to places known beforehand, so that
  /// the tests overlap.
  template <bool kAny, bool kSameSigns>
  LANELIGHT_INLINE void SetChildren(const PacketSlabs& slabs, VF t, const WideNode& node,
                                    uint32_t octant, uint32_t rays) {
    const DF df;
    const uint32_t order = VisitOrder<kAny>(node, octant);
    uint32_t entered = 0;
    for (uint32_t j = 0; j < kBvhWidth; ++j) {
      const uint32_t c = j ^ order;
      VF enter = hn::Zero(df), leave = t;
      for (int a = 0; a < 3; ++a) {
        const uint32_t negative = kSameSigns ? octant >> a & 1 : 0;
        VF p = Splat(node.bounds[a][negative][c]);
        VF q = Splat(node.bounds[a][negative ^ 1][c]);
        if constexpr (!kSameSigns) {
          const VF lower = p;
          p = hn::IfThenElse(slabs.negative[a], q, p);
          q = hn::IfThenElse(slabs.negative[a], lower, q);
        }
        enter = hn::Max(enter, hn::MulAdd(p, slabs.rcp[a], slabs.near[a]));
        leave = hn::Min(leave, hn::MulAdd(q, slabs.rcp[a], slabs.far[a]));
      }
      if constexpr (!kAny) hn::Store(enter, df, entry[j]);
      ref[j] = node.child[c];
      lanes[j] = rays & MaskBits(df, hn::Le(enter, leave));
      entered |= uint32_t{lanes[j] != 0} << j;
    }
    open = entered;
  }
};

/// So many hold the path from the root to a node.
inline constexpr int kPacketFrames = kTraversalStack / (kBvhWidth - 1) + 2;

LANELIGHT_END_KERNELS

#endif
