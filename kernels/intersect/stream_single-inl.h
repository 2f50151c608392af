// Second phase of a stream: single rays, interleaved. In each round every ray takes one
// step (a node or a leaf). A ray by itself is a chain of dependent loads and of branches
// that cannot be predicted; here a node step has no branch, steps of different rays
// overlap in the processor, and what a ray needs next is prefetched a round before.
#ifndef LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_
#define LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_

#include <algorithm>
#include <bit>
#include <type_traits>

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/stream_lists-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "kernels/intersect/stream_stacks-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// Leaves tested before their hits are taken.
inline constexpr uint32_t kLeafBlock = 16;

template <bool kAny, bool kAlpha, bool kInstances>
class SinglePhase {
 public:
  SinglePhase(const SceneParts& scene, StreamRays& rays, Spaces<kInstances>& spaces)
      : scene_(scene), rays_(rays), spaces_(spaces), stacks_(scene, rays) {}

  /// Places of the rays to trace; the packet phase appends them.
  RayList& live() { return lists_.live; }

  /// Traces them to their ends.
  HWY_NOINLINE void Run() {
    for (;;) {
      lists_.Classify(rays_);
      if (lists_.live.size == 0) return;
      if constexpr (kInstances) ChangeSpaces();
      NodeRound();
      if (stacks_.leaf_places().small()) {
        LeafRound<SmallLeaf>(lists_.leaves);
      } else {
        LeafRound<TriangleLeaf>(lists_.leaves);
      }
      LeafRound<SeparateLeaf>(lists_.separate);
    }
  }

 private:
  using Stacks = RayStacks<kAny, kInstances>;
  static constexpr uint32_t kParts = Stacks::kParts;

  // Takes rays back from instances, and others, or the same, into them. What a ray does
  // next cannot be predicted: where it matters, there is no branch.
  HWY_NOINLINE void ChangeSpaces() {
    RayList &entering = lists_.entering, &leaving = lists_.leaving;
    for (uint32_t i = 0; i < leaving.size; ++i) {
      const auto r = static_cast<uint32_t>(leaving.place[i]);
      stacks_.Pop(r, rays_.top[r]);
      spaces_.Leave(r);
      entering.place[entering.size++] = leaving.place[i];
    }
    uint32_t entered = 0;
    for (uint32_t i = 0; i < entering.size; ++i) {
      const auto r = static_cast<uint32_t>(entering.place[i]);
      if (HWY_UNLIKELY(HasNothingInside(r))) SkipInstance(r);
      entering.place[entered] = entering.place[i];
      entered += uint32_t{Next(r) < kReturnRef} & (Next(r) >> 31);
    }
    spaces_.Enter(entering.place, entered);
    for (uint32_t i = 0; i < entered; ++i) {
      const auto r = static_cast<uint32_t>(entering.place[i]);
      const uint32_t group = scene_.geometry->instance_group[rays_.space[r]];
      stacks_.PushInstanceRoot(r, scene_.accel->groups[group].root, IsResume(Next(r)));
    }
  }

  // Returns whether the ray's next entry leads into an instance in which nothing is left:
  // a hit may have culled all that a packet deferred there.
  LANELIGHT_INLINE bool HasNothingInside(uint32_t r) const {
    return IsResume(Next(r)) && stacks_.NothingInside(r);
  }
  // Goes on behind the way back from it.
  HWY_NOINLINE void SkipInstance(uint32_t r) {
    do {
      stacks_.Pop(r, rays_.top[r] - 1);
    } while (HasNothingInside(r));
  }

  LANELIGHT_INLINE uint32_t Next(uint32_t r) const {
    return static_cast<uint32_t>(rays_.next[r]);
  }

  HWY_NOINLINE void NodeRound() {
    RayList& nodes = lists_.nodes;
    nodes.PadGroup();
    const Stacks stacks = stacks_;
    const WideNode* const first = scene_.accel->nodes.data();
    StreamRays& rays = rays_;
    for (uint32_t k = 0; k < nodes.size; k += kInterleavedRays) {
      NodeStep(rays, stacks, first, nodes.place + k);
    }
  }

  template <class Leaf>
  HWY_NOINLINE void LeafRound(RayList& leaves) {
    leaves.PadGroup();
    const Stacks stacks = stacks_;
    StreamRays& rays = rays_;
    for (uint32_t base = 0; base < leaves.size; base += kLeafBlock) {
      const int32_t* const list = leaves.place + base;
      const uint32_t n = std::min(leaves.size - base, kLeafBlock);
      uint32_t hits = 0;
      for (uint32_t k = 0; k < n; k += kInterleavedRays) {
        hits |= LeafStep<Leaf>(rays, stacks, list + k, k) << k;
      }
      // One of a pair may be there twice.
      for (hits &= (1u << n) - 1; hits != 0; hits &= hits - 1) {
        const auto k = static_cast<uint32_t>(std::countr_zero(hits));
        HitStep<Leaf>(static_cast<uint32_t>(list[k]), bits_[k], weights_[k]);
      }
    }
  }

  static LANELIGHT_INLINE void NodeStep(StreamRays& rays, const Stacks& stacks,
                                        const WideNode* first, const int32_t* list) {
    const WideNode* node[kInterleavedRays];
    uint32_t r[kInterleavedRays], top[kInterleavedRays];
    V8 enter[kInterleavedRays][kParts], leave[kInterleavedRays][kParts];
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      r[j] = static_cast<uint32_t>(list[j]);
      node[j] = first + static_cast<uint32_t>(rays.next[r[j]]);
    }
    for (uint32_t part = 0; part < kParts; ++part) {
      TestSlabs(rays, r, node, part, enter, leave);
    }
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      top[j] = stacks.PushEntered(r[j], *node[j], enter[j], leave[j]);
    }
    for (uint32_t j = 0; j < kInterleavedRays; ++j) stacks.Pop(r[j], top[j]);
  }

  // Computes where rays r[j] enter and leave the children of a part of node[j].
  static LANELIGHT_INLINE void TestSlabs(const StreamRays& rays,
                                         const uint32_t (&r)[kInterleavedRays],
                                         const WideNode* const (&node)[kInterleavedRays],
                                         uint32_t part,
                                         V8 (&enter)[kInterleavedRays][kParts],
                                         V8 (&leave)[kInterleavedRays][kParts]) {
    const D8 d8;
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      enter[j][part] = hn::Zero(d8);
      leave[j][part] = hn::Set(d8, rays.t[r[j]]);
    }
    for (int a = 0; a < 3; ++a) {
      for (uint32_t j = 0; j < kInterleavedRays; ++j) {
        constexpr uint32_t kUpper = kBvhWidth * sizeof(float);
        const AxisSlab& slab = rays.slab[a][r[j]];
        const auto lower = std::bit_cast<uint32_t>(slab.lower);
        const auto planes = [&](uint32_t offset) HWY_ATTR {
          const char* at = reinterpret_cast<const char*>(node[j]->bounds[a]) + offset;
          return hn::Load(d8, reinterpret_cast<const float*>(at) + part * Lanes8());
        };
        const V8 rcp = hn::Set(d8, slab.rcp);
        enter[j][part] = hn::Max(enter[j][part],
                                 hn::MulAdd(planes(lower), rcp, hn::Set(d8, slab.near)));
        leave[j][part] = hn::Min(leave[j][part], hn::MulAdd(planes(lower ^ kUpper), rcp,
                                                            hn::Set(d8, slab.far)));
      }
    }
  }

  template <class Leaf>
  LANELIGHT_INLINE const Leaf& LeafOf(uint32_t r) const {
    return stacks_.leaf_places().template Of<Leaf>(static_cast<uint32_t>(rays_.next[r]));
  }

  // Rays whose lines pass through no triangle go on; the others wait for HitStep. Returns
  // which, as bits.
  template <class Leaf>
  LANELIGHT_INLINE uint32_t LeafStep(StreamRays& rays, const Stacks& stacks,
                                     const int32_t* list, uint32_t at) {
    LeafRay ray[kInterleavedRays];
    const Leaf* leaf[kInterleavedRays];
    LeafWeights* weights[kInterleavedRays];
    uint32_t r[kInterleavedRays], next[kInterleavedRays], bits[kInterleavedRays],
        top[kInterleavedRays];
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      r[j] = static_cast<uint32_t>(list[j]);
      next[j] = static_cast<uint32_t>(rays.next[r[j]]);
      leaf[j] = &stacks.leaf_places().template Of<Leaf>(next[j]);
      ray[j] = rays.AtLeaf(r[j]);
      weights[j] = &weights_[at + j];
    }
    TestLeaves(ray, leaf, weights, bits);
    for (uint32_t j = 0; j < kInterleavedRays; ++j) top[j] = rays.top[r[j]];
    uint32_t hits = 0;
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      const uint32_t none = bits[j] == 0;
      bits_[at + j] = bits[j];
      hits |= (none ^ 1) << j;
      stacks.PopIf(none, r[j], top[j], next[j]);
    }
    return hits;
  }

  // Takes the nearest of the triangles that the line of the ray passes through, and goes
  // on.
  template <class Leaf>
  HWY_NOINLINE void HitStep(uint32_t r, uint32_t bits, const LeafWeights& weights) {
    const Leaf& leaf = LeafOf<Leaf>(r);
    const auto copy_ray = [&](float o[3], float d[3]) HWY_ATTR {
      for (int a = 0; a < 3; ++a) o[a] = rays_.o[a][r], d[a] = rays_.d[a][r];
    };
    const auto copy_mapped = [&](float o[3], float d[3]) HWY_ATTR {
      copy_ray(o, d);
      if constexpr (kInstances) spaces_.Map(r, o, d);
    };
    bool closer = false;
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      const auto prim = static_cast<int32_t>(leaf.prim[i]);
      LaneHit hit;
      const bool ahead =
          FinishLane(leaf, weights, i, rays_.shear_o[r].t_scale, copy_mapped, hit);
      if (!(ahead & IsBetter(r, hit.t, prim))) continue;
      const float b1 = hit.v / hit.det, b2 = hit.w / hit.det;
      if constexpr (kAlpha) {
        float o[3], d[3];
        copy_ray(o, d);
        if (!TrianglePassesAlpha(scene_, o, d, {leaf.prim[i], b1, b2})) continue;
      }
      rays_.found[r] = 1;
      if constexpr (kAny) {
        rays_.next[r] = static_cast<int32_t>(kEmptyRef);
        return;
      }
      closer = true;
      rays_.t[r] = hit.t;
      rays_.prim[r] = prim;
      rays_.b1[r] = b1;
      rays_.b2[r] = b2;
      if constexpr (kInstances) rays_.inst[r] = rays_.space[r];
    }
    if (closer) stacks_.Cull(r);
    stacks_.Pop(r, rays_.top[r]);
  }

  // Ties go to the smaller primitive, then to the smaller instance.
  LANELIGHT_INLINE bool IsBetter(uint32_t r, float t, int32_t prim) const {
    const bool closer = t < rays_.t[r];
    if constexpr (kAny) return closer;
    bool tie_won = prim < rays_.prim[r];
    if constexpr (kInstances) {
      tie_won |= (prim == rays_.prim[r]) & (rays_.space[r] < rays_.inst[r]);
    }
    return closer | ((t == rays_.t[r]) & tie_won);
  }

  const SceneParts& scene_;
  StreamRays& rays_;
  Spaces<kInstances>& spaces_;
  Stacks stacks_;
  RayLists<kInstances> lists_;
  uint32_t bits_[kLeafBlock + kInterleavedRays];
  LeafWeights weights_[kLeafBlock + kInterleavedRays];
};

LANELIGHT_END_KERNELS

#endif
