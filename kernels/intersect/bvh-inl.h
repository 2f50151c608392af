// Traversal of the 8-wide BVH by one ray: the lanes are the children of a node.
//
// Boxes are grown by delta = margin + slack |o| (src/scene/geometry/accel.h), beyond what
// the builder grew them by in proportion to the coordinates of each shape
// (src/scene/accel/shape_items.h), so that a node is never culled by rounding if it holds
// a hit nearer than, or as near as, the best one: then the hit found does not depend on
// the order of traversal. In parameters of the ray that growth is delta / |d|, so it goes
// into the constant term of the slab test and costs nothing: near = lower / d - (o / d +
// delta / |d|). Compared with Ize 2013, "Robust BVH Ray Traversal", whose growth is
// relative to t, this also covers the rounding of the shape tests, which is relative to
// the coordinates. The slab test itself errs by at most 5 u (|b| + |o|) / |d|, b the
// plane, u = 2^-24.
#ifndef LANELIGHT_INTERSECT_BVH_INL_H_
#define LANELIGHT_INTERSECT_BVH_INL_H_

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <limits>

#include "kernels/intersect/triangle-inl.h"
#include "src/base/core/check.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

// Lanes of node and leaf tests: 8, or 4 twice on narrow targets.
using D8 = hn::CappedTag<float, kBvhWidth>;
using V8 = hn::Vec<D8>;
using M8 = hn::Mask<D8>;
LANELIGHT_INLINE constexpr int Lanes8() { return static_cast<int>(hn::MaxLanes(D8())); }

/// A ray visits the slots k ^ (this), k = 0, 1, ...
template <bool kAny>
LANELIGHT_INLINE uint32_t VisitOrder(const WideNode& node, uint32_t octant) {
  return kAny ? (octant & node.shadow_octants) ^ node.shadow_first : octant;
}

/// A ray prepared for the slab test: the parameter of plane b of axis a is
/// b * rcp[a] + (near or far)[a].
struct SlabRay {
  V8 rcp[3], near[3], far[3];
  int lower[3];  // 0 if the near plane of the axis is the lower one, else kBvhWidth
};

LANELIGHT_INLINE float LargestCoordinate(const float o[3]) {
  return std::max({std::abs(o[0]), std::abs(o[1]), std::abs(o[2])});
}

LANELIGHT_INLINE SlabRay MakeSlabRay(const float o[3], const float d[3], const Bvh& bvh) {
  const D8 d8;
  const float delta = bvh.margin + bvh.slack * LargestCoordinate(o);
  SlabRay ray;
  bool no_number = false;
  for (int a = 0; a < 3; ++a) {
    // A direction this small moves less than delta across the scene; zero would give
    // 0 * inf.
    const float da = std::abs(d[a]) < 0x1p-80f ? std::copysign(0x1p-80f, d[a]) : d[a];
    const float rcp = 1 / da;
    ray.rcp[a] = hn::Set(d8, rcp);
    ray.near[a] = hn::Set(d8, -(o[a] * rcp) - delta * std::abs(rcp));
    ray.far[a] = hn::Set(d8, -(o[a] * rcp) + delta * std::abs(rcp));
    ray.lower[a] = std::signbit(da) ? kBvhWidth : 0;
    no_number |= !(std::abs(o[a] * rcp) <= FLT_MAX);
  }
  // Min and Max treat NaN differently on each target, so a ray with NaN enters nothing.
  if (HWY_UNLIKELY(no_number)) {
    ray.rcp[0] = hn::Set(d8, 1.0f);
    ray.near[0] = hn::Set(d8, std::numeric_limits<float>::infinity());
    ray.far[0] = hn::Neg(ray.near[0]);
    ray.lower[0] = 0;
  }
  return ray;
}

/// Children of the node that the ray meets before t_max, as bits; their entry distances.
LANELIGHT_INLINE uint32_t HitChildren(const SlabRay& ray, const WideNode& node,
                                      float t_max, float* HWY_RESTRICT entry) {
  const D8 d8;
  uint32_t bits = 0;
  for (int i = 0; i < kBvhWidth; i += Lanes8()) {
    V8 enter = hn::Zero(d8), leave = hn::Set(d8, t_max);
    for (int a = 0; a < 3; ++a) {
      const float* planes = node.bounds[a][0] + i;
      const V8 near = hn::Load(d8, planes + ray.lower[a]);
      const V8 far = hn::Load(d8, planes + (kBvhWidth - ray.lower[a]));
      enter = hn::Max(enter, hn::MulAdd(near, ray.rcp[a], ray.near[a]));
      leave = hn::Min(leave, hn::MulAdd(far, ray.rcp[a], ray.far[a]));
    }
    hn::Store(enter, d8, entry + i);
    bits |= MaskBits(d8, hn::Le(enter, leave)) << i;
  }
  return bits;
}

/// A node to visit: entry distance in the high word, so that keys sort by distance
/// (distances are not negative, so their bits order as integers).
LANELIGHT_INLINE uint64_t StackKey(float entry, uint32_t ref) {
  return uint64_t{std::bit_cast<uint32_t>(entry)} << 32 | ref;
}
LANELIGHT_INLINE float EntryOf(uint64_t key) {
  return std::bit_cast<float>(static_cast<uint32_t>(key >> 32));
}

/// Pushes the children in `bits` except the nearest, farthest first, and returns the
/// nearest.
LANELIGHT_INLINE uint32_t PushChildren(const WideNode& node, uint32_t bits,
                                       const float* entry, uint64_t*& top) {
  const int first = std::countr_zero(bits);
  bits &= bits - 1;
  if (bits == 0) return node.child[first];
  uint64_t best = StackKey(entry[first], node.child[first]);
  uint64_t* const base = top;
  do {
    const int i = std::countr_zero(bits);
    bits &= bits - 1;
    uint64_t key = StackKey(entry[i], node.child[i]);
    if (key < best) std::swap(key, best);
    // Insertion keeps the run descending, so that the nearest is popped first.
    uint64_t* at = top++;
    for (; at != base && at[-1] < key; --at) *at = at[-1];
    *at = key;
    LL_DCHECK(at == base || at[-1] >= key);
  } while (bits != 0);
  return static_cast<uint32_t>(best);
}

struct NothingAhead {
  LANELIGHT_INLINE void operator()(uint32_t) const {}
};

/// Visits the leaves that the ray (a SlabRay, or a Frustum) meets before `t_max`, roughly
/// nearest first. `leaf` may lower t_max; it returns true to end the traversal. `ahead`
/// is told what is likely to come next, a node or a leaf, before the ray meets this one:
/// in trees that no cache holds it may fetch it.
template <class Ray, class Leaf, class Ahead = NothingAhead>
LANELIGHT_INLINE void Traverse(const WideNode* HWY_RESTRICT nodes, uint32_t root,
                               const Ray& ray, const float& t_max, Leaf&& leaf,
                               const Ahead& ahead = {}) {
  if (root == kEmptyRef) return;
  uint64_t stack[kTraversalStack];
  uint64_t* top = stack;
  HWY_ALIGN float entry[kBvhWidth];
  uint32_t ref = root;
  for (;;) {
    if (top != stack) ahead(static_cast<uint32_t>(top[-1]));
    if (ref & kLeafBit) {
      if (leaf(ref & ~kLeafBit)) return;
    } else {
      const WideNode& node = nodes[ref];
      const uint32_t bits = HitChildren(ray, node, t_max, entry);
      if (bits != 0) {
        ref = PushChildren(node, bits, entry, top);
        LL_DCHECK(top <= stack + kTraversalStack);
        continue;
      }
    }
    do {
      if (top == stack) return;
      --top;
    } while (EntryOf(*top) > t_max);
    ref = static_cast<uint32_t>(*top);
  }
}

LANELIGHT_END_KERNELS

#endif
