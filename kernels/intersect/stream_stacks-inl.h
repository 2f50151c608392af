// The stacks of the single rays of a stream: what a ray has yet to visit.
#if defined(LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_
#undef LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_
#else
#define LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_
#endif

#include "hwy/cache_control.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool kAny, bool kInstances>
class RayStacks {
 public:
  /// Vectors that the children of a node take: 1, or 2 on targets of 4 lanes.
  static constexpr uint32_t kParts = kBvhWidth / hn::MaxLanes(D8());

  RayStacks(const CompiledScene& scene, StreamRays& rays)
      : rays_(rays), places_(scene.accel), leaf_places_(scene.accel) {}

  const LeafPlaces& leaf_places() const { return leaf_places_; }

  /// Goes to the top of the stack if `move` is 1, stays where it is if it is 0.
  LANELIGHT_INLINE void Pop(uint32_t r, uint32_t top, uint32_t move = 1) {
    const uint32_t ref = rays_.Refs(r)[top];
    rays_.top[r] = top - move;
    rays_.next[r] = move ? static_cast<int32_t>(ref) : rays_.next[r];
    if (kInstances && ref >= kReturnRef) return;
    const char* const at = places_.At(ref);
    for (int line = 0; line < 4; ++line) hwy::Prefetch(at + line * kCacheLine);
  }

  /// Puts the way back from an instance on the stack.
  LANELIGHT_INLINE void PushReturn(uint32_t r) {
    const uint32_t top = ++rays_.top[r];
    rays_.Refs(r)[top] = kReturnRef;
    rays_.Entries(r)[top] = -1;  // stays when the stack is culled
  }

  /// Pushes the children with entries that are not negative, last slots first, so that
  /// the nearest is on top. Returns the new top.
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

  /// Drops what lies beyond the hit, so that nothing needs to be tested when it is
  /// popped.
  LANELIGHT_INLINE void Cull(uint32_t r) {
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

 private:
  // Where nodes and leaves lie, found without a branch: which of the two is next cannot
  // be predicted.
  struct Places {
    const char* base[2];
    std::size_t unit[2];

    explicit Places(const Accel& accel)
        : base{reinterpret_cast<const char*>(accel.nodes.data()),
               reinterpret_cast<const char*>(accel.triangle_blocks.data())},
          unit{sizeof(WideNode), LeafUnit(accel.leaf_triangles)} {}

    LANELIGHT_INLINE const char* At(uint32_t ref) const {
      const uint32_t leaf = ref >> 31;
      return base[leaf] + (ref & kRefIndex) * unit[leaf];
    }
  };

  StreamRays& rays_;
  Places places_;
  LeafPlaces leaf_places_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
