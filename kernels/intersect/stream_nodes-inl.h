// Nodes in the first phase of a stream: each ray of a packet has its own slab test.
// Subtrees that the packets leave to single rays.
#ifndef LANELIGHT_INTERSECT_STREAM_NODES_INL_H_
#define LANELIGHT_INTERSECT_STREAM_NODES_INL_H_

#include <algorithm>
#include <bit>

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The children of a node that the packet is in, in the order in which its
/// first ray visits them: which lanes enter, and at what distances, unless any hit ends
/// a ray.
struct PacketFrame {
  HWY_ALIGN float entry[kBvhWidth][StreamRays::kLanes];
  uint32_t ref[kBvhWidth], lanes[kBvhWidth];
  uint32_t open;  // children to visit, as bits

  /// Makes a frame whose only child is the root.
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

/// Number of frames that hold the path from the root to any node.
inline constexpr int kPacketFrames = kTraversalStack / (kBvhWidth - 1) + 2;

/// The subtrees that the rays of a packet put off, in the order in which they would visit
/// them. How many rays enter one cannot be predicted: they are listed by compression, and
/// one loop puts all on the stacks of the rays at the end. kEntries: with the distances
/// at which rays enter.
template <bool kEntries>
class DeferredSubtrees {
 public:
  LANELIGHT_INLINE void Clear() { size_ = subtrees_ = 0; }
  bool empty() const { return size_ == 0; }
  /// Returns whether `more` have room, there and on the stacks, which end with one of
  /// their own.
  LANELIGHT_INLINE bool HasRoom(uint32_t more) const {
    return subtrees_ + more < kDeferred;
  }

  /// Adds a subtree for the rays of `lanes`; `entry` has a distance for each lane.
  LANELIGHT_INLINE void Add(uint32_t ref, const float* entry, uint32_t lanes) {
    const DF df;
    const DI di;
    const MF mask = MaskOf(df, lanes);
    const VI compressed = hn::Compress(hn::Iota(di, 0), hn::RebindMask(di, mask));
    hn::StoreU(compressed, di, lane_ + size_);
    hn::StoreU(hn::Set(di, static_cast<int32_t>(ref)), di, ref_ + size_);
    if constexpr (kEntries) {
      hn::StoreU(hn::Compress(hn::Load(df, entry), mask), df, entry_ + size_);
    }
    size_ += static_cast<uint32_t>(std::popcount(lanes));
    ++subtrees_;
  }

  /// Until EndInstance subtrees are those of an instance.
  LANELIGHT_INLINE void BeginInstance() { inside_ = size_; }

  /// Encloses them by the way there and the way back, which must have room, for the rays
  /// that have any.
  LANELIGHT_INLINE void EndInstance(uint32_t instance) {
    if (size_ == inside_) return;
    uint32_t lanes = 0;
    for (uint32_t i = inside_; i < size_; ++i) lanes |= 1u << lane_[i];
    const auto ways = static_cast<uint32_t>(std::popcount(lanes));
    const auto move = [&](auto* column) HWY_ATTR {
      std::copy_backward(column + inside_, column + size_, column + size_ + ways);
    };
    move(lane_);
    move(ref_);
    if constexpr (kEntries) move(entry_);
    const uint32_t back = size_ + ways;
    size_ = back + ways;
    subtrees_ += 2;
    for (uint32_t i = 0; i < ways; ++i, lanes &= lanes - 1) {
      const int32_t lane = std::countr_zero(lanes);
      Set(inside_ + i, ResumeRef(instance), lane);
      Set(back + i, kReturnRef, lane);
    }
  }

  /// Puts them on the stacks of the rays at `at`, first ones on top.
  LANELIGHT_INLINE void Push(StreamRays& rays, uint32_t at) const {
    uint32_t *const refs = rays.refs, *const bottom = rays.bottom + at;
    float* const entries = rays.entries;
    for (uint32_t i = 0; i < size_; ++i) {
      const uint32_t to = --bottom[lane_[i]];
      refs[to] = static_cast<uint32_t>(ref_[i]);
      if constexpr (kEntries) entries[to] = entry_[i];
    }
  }

 private:
  // One that stays when a stack is culled.
  LANELIGHT_INLINE void Set(uint32_t i, uint32_t ref, int32_t lane) {
    lane_[i] = lane;
    ref_[i] = static_cast<int32_t>(ref);
    if constexpr (kEntries) entry_[i] = -1;
  }

  // A vector may be stored behind the last one.
  static constexpr uint32_t kMaxDeferred = kDeferred * StreamRays::kLanes;
  uint32_t size_ = 0, subtrees_ = 0, inside_ = 0;
  int32_t lane_[kMaxDeferred], ref_[kMaxDeferred];
  float entry_[kEntries ? kMaxDeferred : 1];
};

LANELIGHT_END_KERNELS

#endif
