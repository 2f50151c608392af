// First phase of a stream: a vector of rays through the top of the tree together, as far
// as enough of them go the same way. The lanes are rays, each with its own slab test.
#ifndef LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_
#define LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_

#include <algorithm>
#include <bit>

#include "kernels/intersect/packet_shadows-inl.h"
#include "kernels/intersect/stream_lists-inl.h"
#include "kernels/intersect/stream_nodes-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// The least number of a packet's rays that must enter a node or a leaf; fewer are left
/// to the second phase. Other thresholds would make shadow rays among small triangles 10
/// to 25 % faster (soup), but cost 5 to 12 % where walls hide lamps: docs/intersect.md.
template <bool kAny>
inline constexpr int kNodeRays = StreamRays::kLanes >= 16  ? (kAny ? 10 : 12)
                                 : StreamRays::kLanes >= 8 ? (kAny ? 6 : 8)
                                                           : 4;
template <bool kAny>
inline constexpr int kLeafRays = StreamRays::kLanes >= 16  ? (kAny ? 5 : 4)
                                 : StreamRays::kLanes >= 8 ? (kAny ? 3 : 2)
                                                           : 2;
/// At leaves of separate triangles shadow packets of 16 are always tested, few rays one
/// by one: sooner blocked, most need nothing of what would be left (soup 1.2 times as
/// fast; packets of 8 lose 7 %).
template <bool kAny>
inline constexpr int kSeparateLeafRays =
    !kAny || StreamRays::kLanes < 16 ? kLeafRays<kAny> : 1;
/// The same for instances and the nodes in them, not for leaves: single rays must be
/// brought there one by one. From 3 to 10 of 16 are within 5 %, 1 is a tenth slower.
inline constexpr int kInsideRays = (3 * StreamRays::kLanes + 4) / 8;

template <bool kAny, bool kAlpha, bool kInstances>
class PacketPhase {
 public:
  PacketPhase(const SceneParts& scene, StreamRays& rays, Spaces<kInstances>& spaces)
      : scene_(scene), rays_(rays), spaces_(spaces) {}

  /// Traces the rays at [at, at + lanes) through the world. What is left for single rays
  /// lies on their stacks, nearest on top; their places are appended to `live`, those
  /// with nothing left, too.
  LANELIGHT_INLINE void Run(uint32_t at, RayList& live) {
    RunIn<false>(scene_.accel->groups[0], at, live);
  }

  /// Traces them through the BVH over instances, after the world.
  LANELIGHT_INLINE void RunTop(uint32_t at, RayList& live) {
    RunIn<true>(scene_.accel->top, at, live);
  }

 private:
  // Instances have many places for one triangle.
  static constexpr bool kCachesBlockers = kAny && !kInstances;

  template <bool kTop>
  LANELIGHT_INLINE void RunIn(const Bvh& tree, uint32_t at, RayList& live) {
    const uint32_t end = at + std::min(StreamRays::kLanes, rays_.size - at);
    for (uint32_t r = at; r < end; ++r) rays_.bottom[r] = rays_.StackEnd(r);
    deferred_.Clear();
    at_ = at;
    uint32_t lanes = (1u << (end - at)) - 1;
    if constexpr (kAny && kTop) lanes &= ~Found(at);
    if (lanes != 0) {
      const Rays rays = rays_.Load(at);
      const PacketSlabs slabs = SlabsIn(tree, rays);
      if constexpr (kTop) {
        Trace<true>(tree.root, slabs, PacketRays{rays, {}}, lanes);
        if (!deferred_.empty()) spaces_.Prepare(rays, slabs, at);
      } else {
        const PacketRays packet = PacketIn(tree, rays, lanes);
        rays_.SetSlabs(slabs, at);
        rays_.SetShear(packet.shear, AxisOrder(rays.d), rays.from, at);
        Trace<false>(tree.root, slabs, packet, lanes);
      }
    }
    deferred_.Push(rays_, at);
    for (uint32_t r = at; r < end; ++r) {
      BeginSingle(r);
      live.place[live.size++] = static_cast<int32_t>(r);
    }
  }

  static LANELIGHT_INLINE PacketSlabs SlabsIn(const Bvh& tree, const Rays& rays) {
    return {rays.o, rays.d, Splat(tree.slack), Splat(tree.margin)};
  }
  static LANELIGHT_INLINE PacketRays PacketIn(const Bvh& tree, const Rays& rays,
                                              uint32_t lanes) {
    const AxisOrder order(rays.d);
    return MakePacket(rays, MakeShear(order, rays, Splat(tree.reach)), order, lanes);
  }

  // The lanes at `at` that have a hit.
  LANELIGHT_INLINE uint32_t Found(uint32_t at) const {
    const DI di;
    return MaskBits(di, hn::Ne(hn::LoadU(di, rays_.found + at), hn::Zero(di)));
  }

  // Traces the rays of `lanes`, one at least, which lie at at_. In the tree over
  // instances leaves are these.
  template <bool kTop>
  LANELIGHT_INLINE void Trace(uint32_t root, const PacketSlabs& slabs,
                              const PacketRays& packet, uint32_t lanes) {
    const DI di;
    const int32_t first = hn::ExtractLane(slabs.octant, std::countr_zero(lanes));
    const auto same = hn::Eq(slabs.octant, hn::Set(di, first));
    if ((MaskBits(di, same) & lanes) == lanes) {
      TraceNodes<kTop, true>(root, slabs, packet, lanes);
    } else {
      TraceNodes<kTop, false>(root, slabs, packet, lanes);
    }
  }

  template <bool kTop, bool kSameSigns>
  HWY_NOINLINE void TraceNodes(uint32_t root, const PacketSlabs& packet_slabs,
                               const PacketRays& packet, uint32_t valid) {
    const DF df;
    const bool inside = kInstances && !kTop && inside_;
    const int node_rays = inside ? kInsideRays : kNodeRays<kAny>;
    const int leaf_rays = kTop ? kInsideRays : inside ? 1 : kLeafRays<kAny>;
    const int separate_rays = kTop ? kInsideRays : inside ? 1 : kSeparateLeafRays<kAny>;
    const PacketSlabs slabs = packet_slabs;
    HWY_ALIGN int32_t octants[StreamRays::kLanes];
    hn::Store(slabs.octant, DI(), octants);
    PacketBest best = NoHits(packet.rays.t_max, hn::LoadU(DI(), rays_.prim + at_));
    uint32_t rays = valid & MaskBits(df, slabs.Finite());
    if constexpr (kCachesBlockers) {
      blockers_.Test(scene_, packet, rays, best);
      rays &= ~best.found;
    }
    PacketFrame frames[kPacketFrames];
    PacketFrame* frame = frames;
    frame->SetRoot(root, rays);
    while (PacketFrame::Next(frames, frame)) {
      const int child = std::countr_zero(frame->open);
      frame->open &= frame->open - 1;
      const uint32_t ref = frame->ref[child];
      const float* entry = frame->entry[child];
      uint32_t lanes = frame->lanes[child];
      if constexpr (kAny) {
        lanes &= ~best.found;
      } else {
        lanes &= MaskBits(df, hn::Le(hn::Load(df, entry), best.t));
      }
      if (lanes == 0) continue;
      const bool is_leaf = ref & kLeafBit;
      const int at_leaf = ref & kSeparateBit ? separate_rays : leaf_rays;
      const bool few = std::popcount(lanes) < (is_leaf ? at_leaf : node_rays);
      if (few && Defer(ref, entry, lanes)) continue;
      if (!is_leaf) {
        const auto octant = static_cast<uint32_t>(octants[std::countr_zero(lanes)]);
        (++frame)->template SetChildren<kAny, kSameSigns>(
            slabs, best.t, scene_.accel->nodes[ref], octant, lanes);
      } else if constexpr (kTop) {
        spaces_.HasMotion() ? EnterInstance<true>(ref & ~kLeafBit, lanes)
                            : EnterInstance<false>(ref & ~kLeafBit, lanes);
        best.t = hn::LoadU(df, rays_.t + at_);
        if constexpr (kAny) best.found |= Found(at_);
      } else {
        TestLeaf(ref, packet, lanes, best);
      }
    }
    if constexpr (kCachesBlockers) {
      if (best.blocker != kNoPrimitive) blockers_.Add(best.blocker);
    }
    if constexpr (!kTop) StoreHits(best);
  }

  // Not inlined: it takes long to compile, and TraceNodes has several variants.
  HWY_NOINLINE void TestLeaf(uint32_t ref, const PacketRays& packet, uint32_t lanes,
                             PacketBest& best) {
    if constexpr (kAny) {
      // A beam saves a packet of 4 more than this does.
      const bool may = StreamRays::kLanes >= 8 || !packet.has_beam;
      if (may && HWY_UNLIKELY(ref & kSeparateBit) &&
          std::popcount(lanes) <= kSingleRays) {
        const auto& leaf = LeafPlaces(*scene_.accel).template Of<SeparateLeaf>(ref);
        if (kInstances && !has_columns_) FillColumns(packet);
        const PacketPlace place{rays_, at_, inside_ ? home_ : at_};
        return TestLeafSingles<kAlpha>(scene_, leaf, place, lanes, best);
      }
    }
    TestLeafPacket<kAny, kAlpha>(scene_, ref, packet, lanes, best);
  }

  // Fills the columns that single rays read at leaves; a packet in an instance has none
  // yet.
  HWY_NOINLINE void FillColumns(const PacketRays& packet) {
    has_columns_ = true;
    rays_.Store(packet.rays, at_);
    rays_.SetShear(packet.shear, AxisOrder(packet.rays.d), packet.rays.from, at_);
  }

  // Traces the rays of `lanes` through an instance. They are moved to its space in the
  // columns behind the last ray, and their hits are taken back.
  template <bool kMoving>
  HWY_NOINLINE void EnterInstance(uint32_t instance, uint32_t lanes) {
    const Bvh& group = scene_.accel->groups[scene_.geometry->instance_group[instance]];
    const uint32_t home = at_, to = rays_.size;
    const Rays rays = MoveRays<kMoving>(instance, home, to);
    PacketRays packet = PacketIn(group, rays, lanes);
    if constexpr (kAlpha) packet.home = rays_.Load(home), home_ = home;
    has_columns_ = false;
    inside_ = true;
    at_ = to;
    deferred_.BeginInstance();
    Trace<false>(group.root, SlabsIn(group, rays), packet, lanes);
    deferred_.EndInstance(instance);
    at_ = home;
    inside_ = false;
    has_columns_ = true;
    for (uint32_t bits = lanes; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      if (!rays_.found[to + i]) continue;
      rays_.CopyHit(to + i, home + i);
      rays_.inst[home + i] = instance;
    }
  }

  // The rays at `home` in the space of an instance, where their hits lie at `to`.
  template <bool kMoving>
  LANELIGHT_INLINE Rays MoveRays(uint32_t instance, uint32_t home, uint32_t to) {
    const DI di;
    const Rays rays = spaces_.template Mapped<kMoving>(instance, home);
    const VI prim = hn::LoadU(di, rays_.prim + home);
    const VI inst = hn::LoadU(di, reinterpret_cast<const int32_t*>(rays_.inst) + home);
    hn::StoreU(TieBreakPrimitives(prim, inst, instance), di, rays_.prim + to);
    hn::StoreU(hn::Zero(di), di, rays_.found + to);
    return rays;
  }

  // Leaves a subtree to single rays; false if there may be no room for it.
  LANELIGHT_INLINE bool Defer(uint32_t ref, const float* entry, uint32_t lanes) {
    // In an instance also for the way there and back.
    if (!deferred_.HasRoom(kInstances && inside_ ? 3 : 1)) return false;
    deferred_.Add(ref, entry, lanes);
    return true;
  }

  LANELIGHT_INLINE void StoreHits(const PacketBest& best) {
    const DF df;
    const DI di;
    hn::StoreU(best.t, df, rays_.t + at_);
    const auto found = hn::RebindMask(di, MaskOf(df, best.found));
    hn::StoreU(hn::IfThenElseZero(found, hn::Set(di, 1)), di, rays_.found + at_);
    if constexpr (kAny) return;
    hn::StoreU(best.prim, di, rays_.prim + at_);
    hn::StoreU(hn::Div(best.v, best.det), df, rays_.b1 + at_);
    hn::StoreU(hn::Div(best.w, best.det), df, rays_.b2 + at_);
  }

  // Puts the end below the stack of a ray, and takes the nearest subtree off it: the end
  // if there is none. Without a branch, which could not be predicted.
  LANELIGHT_INLINE void BeginSingle(uint32_t r) {
    const uint32_t end = --rays_.bottom[r], top = rays_.StackEnd(r) - 1;
    rays_.refs[end] = kEmptyRef;
    if constexpr (!kAny) rays_.entries[end] = -1;
    const uint32_t blocked = kAny ? static_cast<uint32_t>(-rays_.found[r]) : 0;
    rays_.next[r] = static_cast<int32_t>(rays_.refs[top] | blocked);
    rays_.top[r] = top - 1;
  }

  const SceneParts& scene_;
  StreamRays& rays_;
  Spaces<kInstances>& spaces_;
  bool inside_ = false;      // an instance
  bool has_columns_ = true;  // single rays can read the packet's
  uint32_t at_ = 0;          // place of the rays
  DeferredSubtrees<!kAny> deferred_;
  LastBlockers<kAlpha> blockers_;
  uint32_t home_ = 0;  // in an instance: their place in the space of the scene
};

LANELIGHT_END_KERNELS

#endif
