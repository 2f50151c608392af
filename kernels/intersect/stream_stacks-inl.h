// The stacks of the single rays of a stream: what a ray has yet to visit.
#ifndef LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_
#define LANELIGHT_INTERSECT_STREAM_STACKS_INL_H_

#include "hwy/cache_control.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/child_order-inl.h"
#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "kernels/intersect/stream_spaces-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// Copies of it are cheap: a step that has its own keeps it in registers, whatever its
/// vectors are stored to.
template <bool kAny, bool kInstances>
class RayStacks {
 public:
  /// Vectors that the children of a node take: 1, or 2 on targets of 4 lanes.
  static constexpr uint32_t kParts = kBvhWidth / hn::MaxLanes(D8());

  RayStacks(const SceneParts& scene, StreamRays& rays)
      : rays_(&rays),
        refs_(rays.refs),
        entries_(rays.entries),
        places_(*scene.accel),
        leaf_places_(*scene.accel) {}

  const LeafPlaces& leaf_places() const { return leaf_places_; }

  /// Goes to the top of the stack.
  LANELIGHT_INLINE void Pop(uint32_t r, uint32_t top) const {
    const uint32_t ref = refs_[top];
    rays_->top[r] = top - 1;
    rays_->next[r] = static_cast<int32_t>(ref);
    Prefetch(ref);
  }

  /// Pops if `move` is 1; stays at `next` if it is 0. No branch: whether a ray has
  /// something to do at a leaf cannot be predicted.
  LANELIGHT_INLINE void PopIf(uint32_t move, uint32_t r, uint32_t top,
                              uint32_t next) const {
    const uint32_t ref = refs_[top], stay = move - 1;
    rays_->top[r] = top - move;
    rays_->next[r] = static_cast<int32_t>((ref & ~stay) | (next & stay));
    Prefetch(ref);
  }

  /// Goes to the root of an instance, and puts the way back on the stack; or, if
  /// `resume`, to the top of the stack, under which that is.
  LANELIGHT_INLINE void PushInstanceRoot(uint32_t r, uint32_t root, bool resume) const {
    const uint32_t top = rays_->top[r], up = uint32_t{resume} - 1;
    const uint32_t ref = (refs_[top] & ~up) | (root & up);
    refs_[top + 1] = kReturnRef;
    entries_[top + 1] = -1;  // stays when the stack is culled
    rays_->top[r] = top + 1 - 2 * uint32_t{resume};
    rays_->next[r] = static_cast<int32_t>(ref);
    Prefetch(ref);
  }

  /// Returns whether nothing is left in the instance of an entry for which IsResume
  /// holds.
  LANELIGHT_INLINE bool NothingInside(uint32_t r) const {
    return refs_[rays_->top[r]] == kReturnRef;
  }

  /// Pushes the children that the ray enters no later than it leaves them, last slots
  /// first, so that the nearest is on top. Returns the new top.
  LANELIGHT_INLINE uint32_t PushEntered(uint32_t r, const WideNode& node,
                                        const V8 (&enter)[kParts],
                                        const V8 (&leave)[kParts]) const {
    const D8 d8;
    const hn::RebindToUnsigned<D8> du;
    const uint32_t octant = VisitOrder<kAny>(node, rays_->octant[r]);
    uint32_t top = rays_->top[r];
    for (uint32_t k = 0; k < kParts; ++k) {
      // The bit of the octant above the lanes tells which part is last.
      const uint32_t part = (kParts - 1 - k) ^ (kParts > 1 ? octant / Lanes8() : 0);
      const bool first = kParts > 1 && part == 0;
      const EnteredChildren entered(octant, first ? enter[0] : enter[kParts - 1],
                                    first ? leave[0] : leave[kParts - 1]);
      const auto refs = hn::BitCast(d8, hn::Load(du, node.child + part * Lanes8()));
      if constexpr (!kAny) {  // any hit ends the ray: nothing is culled
        hn::StoreU(entered.entries(), d8, entries_ + top + 1);
      }
      hn::StoreU(hn::BitCast(du, entered.InOrder(refs)), du, refs_ + top + 1);
      top += entered.count();
    }
    LL_DCHECK(top < rays_->StackEnd(r) + rays_->stride - kDeferred - kLeafTriangles);
    return top;
  }

  /// Drops what lies beyond the hit, so that nothing needs to be tested when it is
  /// popped.
  LANELIGHT_INLINE void Cull(uint32_t r) const {
    const DF df;
    const hn::RebindToUnsigned<DF> du;
    const uint32_t end = rays_->top[r] + 1;
    const VF t = hn::Set(df, rays_->t[r]);
    uint32_t kept = rays_->bottom[r];
    for (uint32_t i = kept; i < end; i += hn::MaxLanes(df)) {
      const VF entry = hn::LoadU(df, entries_ + i);
      const auto ref = hn::LoadU(du, refs_ + i);
      const MF keep = hn::And(hn::Le(entry, t), hn::FirstN(df, end - i));
      hn::StoreU(hn::Compress(entry, keep), df, entries_ + kept);
      hn::StoreU(hn::Compress(ref, hn::RebindMask(du, keep)), du, refs_ + kept);
      kept += static_cast<uint32_t>(hn::CountTrue(df, keep));
    }
    LL_DCHECK(kept > rays_->bottom[r]);  // the end below always stays
    rays_->top[r] = kept - 1;
  }

 private:
  // The addresses of nodes and leaves, found without a branch: which of the two is next
  // cannot be predicted.
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

  LANELIGHT_INLINE void Prefetch(uint32_t ref) const {
    const bool is_place = !kInstances || ref < kReturnRef;
    const char* const at = places_.At(is_place ? ref : 0);
    for (int line = 0; line < 4; ++line) hwy::Prefetch(at + line * kCacheLine);
  }

  StreamRays* rays_;
  uint32_t* refs_;
  float* entries_;
  Places places_;
  LeafPlaces leaf_places_;
};

LANELIGHT_END_KERNELS

#endif
