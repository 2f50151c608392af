// Second phase of a stream: single rays, interleaved. In each round every ray takes one
// step (a node or a leaf). A ray by itself is a chain of dependent loads and of branches
// that cannot be predicted; here a node step has no branch, steps of different rays
// overlap in the processor, and what a ray needs next is prefetched a round before.
#if defined(LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_
#undef LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_
#else
#define LANELIGHT_INTERSECT_STREAM_SINGLE_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <type_traits>

#include "hwy/cache_control.h"
#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays that take a step together, in one straight run of instructions.
inline constexpr uint32_t kTogether = 2;
/// Leaves tested before their hits are taken.
inline constexpr uint32_t kLeafBlock = 16;

template <bool kAny, bool kAlpha, bool kInstances>
class SinglePhase {
 public:
  SinglePhase(const CompiledScene& scene, StreamRays& rays)
      : scene_(scene),
        rays_(rays),
        spaces_(scene, rays),
        node_base_(reinterpret_cast<const char*>(scene.accel.nodes.data())),
        leaf_places_(scene.accel) {}

  /// Places of the rays to trace; the packet phase appends them.
  int32_t* live() { return live_; }

  /// Moves all rays to the tree over instances, after they were traced through the world.
  LANELIGHT_INLINE void BeginTop() { spaces_.BeginTop(); }

  /// Traces the first `num_live` of them.
  HWY_NOINLINE void Run(uint32_t num_live) {
    num_live_ = num_live;
    for (;;) {
      Classify();
      if (num_live_ == 0) return;
      if constexpr (kInstances) ChangeSpaces();
      NodeRound();
      if (leaf_places_.small()) {
        LeafRound<SmallLeaf>(leaves_, num_leaves_);
      } else {
        LeafRound<TriangleLeaf>(leaves_, num_leaves_);
      }
      LeafRound<SeparateLeaf>(separate_, num_separate_);
    }
  }

 private:
  static constexpr uint32_t kRoom = StreamRays::kRoom;
  // Vectors that the children of a node take: 1, or 2 on targets of 4 lanes.
  static constexpr uint32_t kParts = kBvhWidth / hn::MaxLanes(D8());

  // Lists the rays that are at a node, and those at either kind of leaf. Apart from the
  // steps, which thus store only to places known beforehand: a store to a place that
  // depends on the outcome of a step would hold up the loads of the steps that follow.
  LANELIGHT_INLINE void Classify() {
    const DI di;
    const uint32_t n = num_live_;
    num_live_ = num_nodes_ = num_leaves_ = num_separate_ = 0;
    num_entering_ = num_leaving_ = 0;
    for (uint32_t i = 0; i < n; i += hn::MaxLanes(di)) {
      const auto valid = hn::FirstN(di, n - i);
      const VI rays = hn::IfThenElseZero(valid, hn::LoadU(di, live_ + i));
      const VI next = Gather(rays_.next, rays);
      const auto live = hn::And(valid, hn::Ne(next, hn::Set(di, -1)));
      auto leaf = hn::And(live, hn::Lt(next, hn::Zero(di)));
      if constexpr (kInstances) leaf = ListMoving(rays, next, live, leaf);
      num_nodes_ +=
          Append(rays, hn::AndNot(hn::Lt(next, hn::Zero(di)), live), nodes_ + num_nodes_);
      const auto separate = hn::And(leaf, hn::Lt(hn::ShiftLeft<1>(next), hn::Zero(di)));
      num_leaves_ += Append(rays, hn::AndNot(separate, leaf), leaves_ + num_leaves_);
      num_separate_ += Append(rays, separate, separate_ + num_separate_);
      num_live_ += Append(rays, live, live_ + num_live_);
    }
  }
  // Lists the rays that are at an instance, or at its end; returns the others of `leaf`.
  template <class M>
  LANELIGHT_INLINE M ListMoving(VI rays, VI next, M live, M leaf) {
    const DI di;
    const auto equals = [&](VI v, uint32_t ref)
                            HWY_ATTR { return hn::Eq(v, hn::Set(di, int32_t(ref))); };
    const M leaving = hn::And(live, equals(next, kReturnRef));
    const VI space = Gather(reinterpret_cast<const int32_t*>(rays_.space), rays);
    const M entering = hn::AndNot(leaving, hn::And(leaf, equals(space, kTopSpace)));
    num_leaving_ += Append(rays, leaving, leaving_ + num_leaving_);
    num_entering_ += Append(rays, entering, entering_ + num_entering_);
    return hn::AndNot(hn::Or(leaving, entering), leaf);
  }

  // Takes rays back from instances, and others into them.
  HWY_NOINLINE void ChangeSpaces() {
    for (uint32_t i = 0; i < num_leaving_; ++i) {
      const auto r = static_cast<uint32_t>(leaving_[i]);
      spaces_.Leave(r);
      Pop(r, rays_.top[r]);
    }
    spaces_.Enter(entering_, num_entering_);
    for (uint32_t i = 0; i < num_entering_; ++i) {
      const auto r = static_cast<uint32_t>(entering_[i]);
      const uint32_t top = ++rays_.top[r];
      rays_.Refs(r)[top] = kReturnRef;
      rays_.Entries(r)[top] = -1;  // stays when the stack is culled
    }
  }

  template <class M>
  static LANELIGHT_INLINE uint32_t Append(VI rays, M mask, int32_t* to) {
    hn::StoreU(hn::Compress(rays, mask), DI(), to);
    return static_cast<uint32_t>(hn::CountTrue(DI(), mask));
  }

  // Fills the last group up with its last ray, whose step is then done twice.
  static LANELIGHT_INLINE void PadGroup(int32_t* list, uint32_t n) {
    for (uint32_t j = 0; n > 0 && j < kTogether; ++j) list[n + j] = list[n - 1];
  }
  HWY_NOINLINE void NodeRound() {
    PadGroup(nodes_, num_nodes_);
    for (uint32_t k = 0; k < num_nodes_; k += kTogether) NodeStep(nodes_ + k);
  }
  template <class Leaf>
  HWY_NOINLINE void LeafRound(int32_t* list, uint32_t count) {
    PadGroup(list, count);
    for (uint32_t base = 0; base < count; base += kLeafBlock) {
      const uint32_t n = std::min(count - base, kLeafBlock);
      for (uint32_t k = 0; k < n; k += kTogether) LeafStep<Leaf>(list + base + k, k);
      for (uint32_t k = 0; k < n; ++k) {
        if (bits_[k] == 0) continue;
        HitStep<Leaf>(static_cast<uint32_t>(list[base + k]), bits_[k], weights_[k]);
      }
    }
  }

  // Goes to the top of the stack if `move` is 1, stays where it is if it is 0.
  LANELIGHT_INLINE void Pop(uint32_t r, uint32_t top, uint32_t move = 1) {
    const uint32_t ref = rays_.Refs(r)[top];
    rays_.top[r] = top - move;
    rays_.next[r] = move ? static_cast<int32_t>(ref) : rays_.next[r];
    if (kInstances && ref >= kReturnRef) return;
    const char* const node = node_base_ + std::size_t{ref} * sizeof(WideNode);
    const char* const at = ref & kLeafBit ? leaf_places_.At(ref) : node;
    for (int line = 0; line < 4; ++line) hwy::Prefetch(at + line * kCacheLine);
  }

  LANELIGHT_INLINE void NodeStep(const int32_t* list) {
    const D8 d8;
    const WideNode* node[kTogether];
    uint32_t r[kTogether], top[kTogether];
    V8 entered[kTogether][kParts];
    for (uint32_t j = 0; j < kTogether; ++j) {
      r[j] = static_cast<uint32_t>(list[j]);
      node[j] = &scene_.accel.nodes[static_cast<uint32_t>(rays_.next[r[j]])];
    }
    for (uint32_t part = 0; part < kParts; ++part) {
      V8 enter[kTogether], leave[kTogether];
      TestSlabs(r, node, part, enter, leave);
      for (uint32_t j = 0; j < kTogether; ++j) {
        entered[j][part] =
            hn::IfThenElse(hn::Le(enter[j], leave[j]), enter[j], hn::Set(d8, -1.0f));
      }
    }
    for (uint32_t j = 0; j < kTogether; ++j) {
      top[j] = PushEntered(r[j], *node[j], entered[j]);
    }
    for (uint32_t j = 0; j < kTogether; ++j) Pop(r[j], top[j]);
  }

  // Where rays r[j] enter and leave the children of a part of node[j].
  LANELIGHT_INLINE void TestSlabs(const uint32_t (&r)[kTogether],
                                  const WideNode* const (&node)[kTogether], uint32_t part,
                                  V8 (&enter)[kTogether], V8 (&leave)[kTogether]) const {
    const D8 d8;
    for (uint32_t j = 0; j < kTogether; ++j) {
      enter[j] = hn::Zero(d8);
      leave[j] = hn::Set(d8, rays_.t[r[j]]);
    }
    for (int a = 0; a < 3; ++a) {
      for (uint32_t j = 0; j < kTogether; ++j) {
        constexpr uint32_t kUpper = kBvhWidth * sizeof(float);
        const uint32_t lower = rays_.lower[a][r[j]];
        const auto planes = [&](uint32_t offset) HWY_ATTR {
          const char* at = reinterpret_cast<const char*>(node[j]->bounds[a]) + offset;
          return hn::Load(d8, reinterpret_cast<const float*>(at) + part * Lanes8());
        };
        const V8 rcp = hn::Set(d8, rays_.rcp[a][r[j]]);
        enter[j] = hn::Max(
            enter[j], hn::MulAdd(planes(lower), rcp, hn::Set(d8, rays_.near[a][r[j]])));
        leave[j] = hn::Min(leave[j], hn::MulAdd(planes(lower ^ kUpper), rcp,
                                                hn::Set(d8, rays_.far[a][r[j]])));
      }
    }
  }

  // Pushes the children with entries that are not negative, last slots first, so that the
  // nearest is on top. Returns the new top.
  LANELIGHT_INLINE uint32_t PushEntered(uint32_t r, const WideNode& node,
                                        const V8 (&entered)[kParts]) {
    const D8 d8;
    const hn::RebindToUnsigned<D8> du;
    constexpr uint32_t kLast = kBvhWidth / kParts - 1;
    const uint32_t octant = rays_.octant[r];
    const auto lane = hn::Xor(hn::Sub(hn::Set(du, kLast), hn::Iota(du, 0)),
                              hn::Set(du, octant & kLast));
    uint32_t top = rays_.top[r];
    for (uint32_t k = 0; k < kParts; ++k) {
      // The bit of the octant above the lanes tells which part is last.
      const uint32_t part = (kParts - 1 - k) ^ (kParts > 1 ? octant / (kLast + 1) : 0);
      const V8 some = kParts > 1 && part == 0 ? entered[0] : entered[kParts - 1];
      const V8 entry = hn::TableLookupLanes(some, hn::IndicesFromVec(d8, lane));
      const auto ref = hn::TableLookupLanes(hn::Load(du, node.child + part * Lanes8()),
                                            hn::IndicesFromVec(du, lane));
      const M8 hit = hn::Ge(entry, hn::Zero(d8));
      if constexpr (!kAny) {  // any hit ends the ray: nothing is culled
        hn::StoreU(hn::Compress(entry, hit), d8, rays_.Entries(r) + top + 1);
      }
      hn::StoreU(hn::Compress(ref, hn::RebindMask(du, hit)), du, rays_.Refs(r) + top + 1);
      top += static_cast<uint32_t>(hn::CountTrue(d8, hit));
    }
    return top;
  }

  template <class Leaf>
  LANELIGHT_INLINE const Leaf& LeafOf(uint32_t r) const {
    return leaf_places_.Of<Leaf>(static_cast<uint32_t>(rays_.next[r]));
  }

  // Rays whose lines pass through no triangle go on; the others wait for HitStep.
  template <class Leaf>
  LANELIGHT_INLINE void LeafStep(const int32_t* list, uint32_t at) {
    LeafRay ray[kTogether];
    const Leaf* leaf[kTogether];
    LeafWeights* weights[kTogether];
    uint32_t r[kTogether], bits[kTogether], top[kTogether];
    for (uint32_t j = 0; j < kTogether; ++j) {
      r[j] = static_cast<uint32_t>(list[j]);
      const auto load = [&](const float(&column)[3][kRoom]) HWY_ATTR {
        return P3<float>{column[0][r[j]], column[1][r[j]], column[2][r[j]]};
      };
      leaf[j] = &LeafOf<Leaf>(r[j]);
      ray[j] = {load(rays_.shear_o),
                load(rays_.shear_s),
                {rays_.row[0][r[j]], rays_.row[1][r[j]], rays_.row[2][r[j]]},
                rays_.from[r[j]]};
      weights[j] = &weights_[at + j];
    }
    TestLeaves(ray, leaf, weights, bits);
    for (uint32_t j = 0; j < kTogether; ++j) top[j] = rays_.top[r[j]];
    for (uint32_t j = 0; j < kTogether; ++j) {
      bits_[at + j] = bits[j];
      Pop(r[j], top[j], bits[j] == 0);
    }
  }

  // Takes the nearest of the triangles that the line of the ray passes through, and goes
  // on.
  template <class Leaf>
  HWY_NOINLINE void HitStep(uint32_t r, uint32_t bits, const LeafWeights& weights) {
    const Leaf& leaf = LeafOf<Leaf>(r);
    const auto copy_ray = [&](float o[3], float d[3]) HWY_ATTR {
      for (int a = 0; a < 3; ++a) o[a] = rays_.o[a][r], d[a] = rays_.d[a][r];
    };
    bool closer = false;
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      const auto prim = static_cast<int32_t>(leaf.prim[i]);
      LaneHit hit;
      if (!FinishLane(leaf, weights, i, copy_ray, hit)) continue;
      const auto [t, b1, b2] = hit;
      if (!IsBetter(r, t, prim)) continue;
      if constexpr (kAlpha) {
        float o[3], d[3];
        copy_ray(o, d);
        if constexpr (kInstances) spaces_.CopyHome(r, o, d);
        if (!TrianglePassesAlpha(scene_, o, d, leaf.prim[i], b1, b2)) continue;
      }
      rays_.found[r] = 1;
      if constexpr (kAny) {
        rays_.next[r] = static_cast<int32_t>(kEmptyRef);
        return;
      }
      closer = true;
      rays_.t[r] = t;
      rays_.prim[r] = prim;
      rays_.b1[r] = b1;
      rays_.b2[r] = b2;
      if constexpr (kInstances) rays_.inst[r] = rays_.space[r];
    }
    if (closer) CullStack(r);
    Pop(r, rays_.top[r]);
  }

  // Ties go to the smaller primitive, then to the smaller instance.
  LANELIGHT_INLINE bool IsBetter(uint32_t r, float t, int32_t prim) const {
    if (kAny || t != rays_.t[r]) return t < rays_.t[r];
    if (!kInstances || prim != rays_.prim[r]) return prim < rays_.prim[r];
    return rays_.space[r] < rays_.inst[r];
  }

  // Drops what lies beyond the hit, so that nothing needs to be tested when it is popped.
  LANELIGHT_INLINE void CullStack(uint32_t r) {
    const DF df;
    const hn::RebindToUnsigned<DF> du;
    uint32_t* refs = rays_.Refs(r);
    float* entries = rays_.Entries(r);
    const uint32_t end = rays_.top[r] + 1;
    const VF t = hn::Set(df, rays_.t[r]);
    uint32_t kept = rays_.bottom[r];
    for (uint32_t i = kept; i < end; i += hn::MaxLanes(df)) {
      const VF entry = hn::LoadU(df, entries + i);
      const auto ref = hn::LoadU(du, refs + i);
      const MF keep = hn::And(hn::Le(entry, t), hn::FirstN(df, end - i));
      hn::StoreU(hn::Compress(entry, keep), df, entries + kept);
      hn::StoreU(hn::Compress(ref, hn::RebindMask(du, keep)), du, refs + kept);
      kept += static_cast<uint32_t>(hn::CountTrue(df, keep));
    }
    rays_.top[r] = kept - 1;
  }

  const CompiledScene& scene_;
  StreamRays& rays_;
  std::conditional_t<kInstances, RaySpaces, NoSpaces> spaces_;
  const char* node_base_;
  LeafPlaces leaf_places_;
  uint32_t num_live_ = 0, num_nodes_ = 0, num_leaves_ = 0, num_separate_ = 0;
  int32_t live_[kRoom], nodes_[kRoom], leaves_[kRoom], separate_[kRoom];
  uint32_t num_entering_ = 0, num_leaving_ = 0;
  int32_t entering_[kInstances ? kRoom : 1], leaving_[kInstances ? kRoom : 1];
  uint32_t bits_[kLeafBlock + kTogether];
  LeafWeights weights_[kLeafBlock + kTogether];
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
