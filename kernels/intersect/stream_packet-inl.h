// First phase of a stream: a vector of rays through the top of the tree together, as far
// as enough of them go the same way. The lanes are rays, each with its own slab test.
#if defined(LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_
#undef LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_
#else
#define LANELIGHT_INTERSECT_STREAM_PACKET_INL_H_
#endif

#include <algorithm>
#include <bit>

#include "kernels/intersect/last_blockers-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A packet goes on into a node, or a leaf, that at least so many of its rays enter.
/// Fewer are left to the second phase. Of 16 lanes, 4 and 6 instead cost shadow rays 12
/// to 18 % and bounces 5 %, 10 and 8 bounces 5 to 10 %; of 8 lanes, 9 and 5 (no packets)
/// cost 20 to 30 %; of 4 lanes, 3 and 2 cost 5 to 12 %. The optimum is flat.
inline constexpr int kNodeRays = StreamRays::kLanes >= 16  ? 10
                                 : StreamRays::kLanes >= 8 ? 6
                                                           : 4;
inline constexpr int kLeafRays = StreamRays::kLanes >= 16 ? 5 : 3;

template <bool kAny, bool kAlpha, bool kInstances>
class PacketPhase {
 public:
  PacketPhase(const CompiledScene& scene, StreamRays& rays)
      : scene_(scene), rays_(rays) {}

  /// Traces the rays at [at, at + lanes) through the world. What is left for single rays
  /// lies on their stacks, nearest on top; the places of those that have some are
  /// appended to `live`.
  LANELIGHT_INLINE void Run(uint32_t at, int32_t* live, uint32_t& num_live) {
    Run(Tree::kWorld, scene_.accel.groups[0].root, at, live, num_live);
  }

  /// The same through the tree over instances, and these, after the world.
  LANELIGHT_INLINE void RunTop(uint32_t at, int32_t* live, uint32_t& num_live) {
    Run(Tree::kTop, scene_.accel.top.root, at, live, num_live);
  }

 private:
  // Instances have many places for one triangle.
  static constexpr bool kRemembers = kAny && !kInstances;
  enum class Tree { kWorld, kTop, kInstance };

  LANELIGHT_INLINE void Run(Tree tree, uint32_t root, uint32_t at, int32_t* live,
                            uint32_t& num_live) {
    count_ = std::min(StreamRays::kLanes, rays_.size - at);
    std::fill_n(rays_.bottom + at, count_, kDeferred);
    Trace(tree, root, at, (1u << count_) - 1);
    for (uint32_t r = at; r < at + count_; ++r) {
      if ((kAny && rays_.found[r]) || rays_.bottom[r] == kDeferred) continue;
      BeginSingle(r);
      live[num_live++] = static_cast<int32_t>(r);
    }
  }

  // Traces the rays of `lanes` at place `at`.
  LANELIGHT_INLINE void Trace(Tree tree, uint32_t root, uint32_t at, uint32_t lanes) {
    const DI di;
    tree_ = tree;
    at_ = at;
    const VI octants = hn::LoadU(di, reinterpret_cast<const int32_t*>(rays_.octant) + at);
    const uint32_t first = rays_.octant[at + std::countr_zero(lanes)];
    const auto same = hn::Eq(octants, hn::Set(di, static_cast<int32_t>(first)));
    if ((MaskBits(di, same) & lanes) == lanes) {
      Trace<true>(root, lanes);
    } else {
      Trace<false>(root, lanes);
    }
  }

  struct Slabs {
    VF rcp[3], near[3], far[3];
    MF negative[3];
  };
  // The children of a node that the packet is in, in the order of their slots seen from
  // its first ray: entry distances, and which lanes enter.
  struct Frame {
    HWY_ALIGN float entry[kBvhWidth][StreamRays::kLanes];
    uint32_t ref[kBvhWidth], lanes[kBvhWidth];
    uint32_t open;  // children to visit, as bits
  };
  static constexpr int kFrames = kTraversalStack / (kBvhWidth - 1) + 2;

  template <bool kSameSigns>
  HWY_NOINLINE void Trace(uint32_t root, uint32_t valid) {
    const DF df;
    Slabs slabs;
    for (int a = 0; a < 3; ++a) {
      slabs.rcp[a] = hn::LoadU(df, rays_.rcp[a] + at_);
      slabs.near[a] = hn::LoadU(df, rays_.near[a] + at_);
      slabs.far[a] = hn::LoadU(df, rays_.far[a] + at_);
      slabs.negative[a] = hn::Lt(slabs.rcp[a], hn::Zero(df));
    }
    const PacketRays packet = LoadPacket(valid);
    PacketBest best = NoHits(packet.rays.t_max, hn::LoadU(DI(), rays_.prim + at_));
    Frame frames[kFrames];
    Frame* frame = frames;
    hn::Store(hn::Zero(df), df, frame->entry[0]);
    frame->ref[0] = root;
    // A ray that is no ray (NaN, infinite) enters nothing: what Min and Max make of NaN
    // differs between targets, and unused children must not be entered.
    const VF sum = hn::Add(slabs.near[0], hn::Add(slabs.near[1], slabs.near[2]));
    frame->lanes[0] = valid & MaskBits(df, hn::IsFinite(sum));
    if constexpr (kRemembers) {
      blockers_.Test(scene_, packet, frame->lanes[0], best);
      frame->lanes[0] &= ~best.found;
    }
    frame->open = root != kEmptyRef;
    while (Next(frames, frame)) {
      const int child = std::countr_zero(frame->open);
      frame->open &= frame->open - 1;
      const uint32_t ref = frame->ref[child];
      const float* entry = frame->entry[child];
      const uint32_t lanes =
          frame->lanes[child] & MaskBits(df, hn::Le(hn::Load(df, entry), best.t));
      if (lanes == 0) continue;
      const bool is_leaf = ref & kLeafBit;
      const bool few = std::popcount(lanes) < (is_leaf ? kLeafRays : kNodeRays);
      if (few && Defer(ref, entry, lanes)) continue;
      if (is_leaf && AtInstance()) {
        EnterInstance(ref & ~kLeafBit, lanes);
        best.t = hn::LoadU(df, rays_.t + at_);
      } else if (is_leaf) {
        TestLeafPacket<kAny, kAlpha>(scene_, ref, packet, lanes, best);
      } else {
        TestChildren<kSameSigns>(slabs, best.t, scene_.accel.nodes[ref], lanes, *++frame);
      }
    }
    if constexpr (kRemembers) {
      if (best.blocker != kNoPrimitive) blockers_.Add(best.blocker);
    }
    if (!AtInstance()) StoreHits(best);
  }

  // Whether leaves are instances.
  LANELIGHT_INLINE bool AtInstance() const { return kInstances && tree_ == Tree::kTop; }

  // Traces the rays of `lanes` through an instance. They are moved to its space in the
  // columns behind the last ray, and their hits are taken back.
  HWY_NOINLINE void EnterInstance(uint32_t instance, uint32_t lanes) {
    const Bvh& group = scene_.accel.groups[scene_.geometry.instance_group[instance]];
    const uint32_t home = at_, count = count_, to = rays_.size;
    MoveRays(instance, group, home, to);
    Trace(Tree::kInstance, group.root, to, lanes);
    tree_ = Tree::kTop;
    at_ = home;
    count_ = count;
    for (uint32_t bits = lanes; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      if (!rays_.found[to + i]) continue;
      rays_.TakeHit(to + i, home + i);
      rays_.inst[home + i] = instance;
    }
  }

  LANELIGHT_INLINE void MoveRays(uint32_t instance, const Bvh& group, uint32_t home,
                                 uint32_t to) {
    const DF df;
    const DI di;
    const Rays rays =
        MapRays(scene_.geometry.instances[instance], rays_.Load3(rays_.o, home),
                rays_.Load3(rays_.d, home), hn::LoadU(df, rays_.t + home));
    rays_.SetSlabs(rays.o, rays.d, Splat(group.slack), Splat(group.margin), to);
    rays_.SetShear(rays, group.reach, to);
    hn::StoreU(rays.t_max, df, rays_.t + to);
    const VI prim = hn::LoadU(di, rays_.prim + home);
    const VI inst = hn::LoadU(di, reinterpret_cast<const int32_t*>(rays_.inst) + home);
    hn::StoreU(PrimsToBeat(prim, inst, instance), di, rays_.prim + to);
    hn::StoreU(hn::Zero(di), di, rays_.found + to);
    hn::StoreU(FromNone(), di, reinterpret_cast<int32_t*>(rays_.from) + to);
    if constexpr (kAlpha) home_ = home;
  }

  // Goes up to a frame with children to visit; false if there is none.
  static LANELIGHT_INLINE bool Next(const Frame* first, Frame*& frame) {
    while (frame->open == 0) {
      if (frame == first) return false;
      --frame;
    }
    return true;
  }

  LANELIGHT_INLINE PacketRays LoadPacket(uint32_t valid) const {
    const DF df;
    const V3 d = rays_.Load3(rays_.d, at_), so = rays_.Load3(rays_.shear_o, at_),
             ss = rays_.Load3(rays_.shear_s, at_);
    const Shear<VF> shear{{so.x, so.y, so.z},
                          {ss.x, ss.y, ss.z},
                          hn::LoadU(df, rays_.abs_dz + at_),
                          hn::LoadU(df, rays_.t_scale + at_)};
    const VI from = hn::LoadU(DI(), reinterpret_cast<const int32_t*>(rays_.from) + at_);
    const Rays rays{rays_.Load3(rays_.o, at_), d, hn::LoadU(df, rays_.t + at_), from};
    PacketRays packet = MakePacket(rays, shear, AxisOrder(d), valid);
    if constexpr (kAlpha && kInstances) {
      if (tree_ == Tree::kInstance) {
        packet.home.o = rays_.Load3(rays_.o, home_);
        packet.home.d = rays_.Load3(rays_.d, home_);
      }
    }
    return packet;
  }

  // Fills the frame of a node. Every child is tested, and everything is stored to places
  // known beforehand, so that the tests overlap.
  template <bool kSameSigns>
  LANELIGHT_INLINE void TestChildren(const Slabs& slabs, VF t, const WideNode& node,
                                     uint32_t lanes, Frame& frame) const {
    const DF df;
    const uint32_t octant = rays_.octant[at_ + std::countr_zero(lanes)];
    uint32_t open = 0;
    for (uint32_t j = 0; j < kBvhWidth; ++j) {
      const uint32_t c = j ^ octant;
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
      hn::Store(enter, df, frame.entry[j]);
      frame.ref[j] = node.child[c];
      frame.lanes[j] = lanes & MaskBits(df, hn::Le(enter, leave));
      open |= uint32_t{frame.lanes[j] != 0} << j;
    }
    frame.open = open;
  }

  // Leaves a subtree to single rays; false if a ray has no room for it.
  LANELIGHT_INLINE bool Defer(uint32_t ref, const float* entry, uint32_t lanes) {
    if (kInstances && tree_ == Tree::kInstance) return false;
    for (uint32_t bits = lanes; bits != 0; bits &= bits - 1) {
      if (rays_.bottom[at_ + std::countr_zero(bits)] < 2) return false;
    }
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(lanes));
      const uint32_t to = --rays_.bottom[at_ + i];
      rays_.Refs(at_ + i)[to] = ref;
      if constexpr (!kAny) rays_.Entries(at_ + i)[to] = entry[i];
    }
    return true;
  }

  LANELIGHT_INLINE void StoreHits(const PacketBest& best) {
    const DF df;
    hn::StoreU(best.t, df, rays_.t + at_);
    for (uint32_t i = 0; i < count_; ++i) rays_.found[at_ + i] = best.found >> i & 1;
    if constexpr (kAny) return;
    hn::StoreU(best.prim, DI(), rays_.prim + at_);
    hn::StoreU(hn::Div(best.v, best.det), df, rays_.b1 + at_);
    hn::StoreU(hn::Div(best.w, best.det), df, rays_.b2 + at_);
  }

  // Puts the end below the stack of a ray, and takes the nearest subtree off it.
  LANELIGHT_INLINE void BeginSingle(uint32_t r) {
    const uint32_t end = --rays_.bottom[r];
    rays_.Refs(r)[end] = kEmptyRef;
    rays_.Entries(r)[end] = -1;
    rays_.next[r] = static_cast<int32_t>(rays_.Refs(r)[kDeferred - 1]);
    rays_.top[r] = kDeferred - 2;
  }

  const CompiledScene& scene_;
  StreamRays& rays_;
  Tree tree_ = Tree::kWorld;
  uint32_t at_ = 0, count_ = 0;  // place and number of the rays
  LastBlockers<kAlpha> blockers_;
  uint32_t home_ = 0;  // in an instance: their place in the space of the scene
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
