// A vector of coherent rays through the BVH together: the lanes are the rays in a leaf
// and the children in a node, where one slab test bounds all rays by intervals of origin
// and reciprocal direction (a frustum; Boulos, Wald and Benthin 2008). Which leaves are
// visited depends on the company of a ray, the hit does not.
#ifndef LANELIGHT_INTERSECT_PACKET_INL_H_
#define LANELIGHT_INTERSECT_PACKET_INL_H_

#include <limits>

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/packet_leaf-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// Intervals of the rays of a packet, axis by axis.
struct PacketBounds {
  float o_min[3], o_max[3], d_min[3], d_max[3];

  /// Computed as far as needed: false as soon as the rays are found not to agree in the
  /// signs of their directions.
  LANELIGHT_INLINE bool Compute(const Rays& rays) {
    const DF df;
    const VF d[3] = {rays.d.x, rays.d.y, rays.d.z};
    const VF o[3] = {rays.o.x, rays.o.y, rays.o.z};
    for (const VF& v : d) {
      const MF negative =
          hn::RebindMask(df, hn::Lt(hn::BitCast(DI(), v), hn::Zero(DI())));
      if (!hn::AllTrue(df, negative) && !hn::AllFalse(df, negative)) return false;
    }
    for (int a = 0; a < 3; ++a) {
      d_min[a] = MinLane(d[a]);
      d_max[a] = MaxLane(d[a]);
      o_min[a] = MinLane(o[a]);
      o_max[a] = MaxLane(o[a]);
    }
    return true;
  }

  /// Returns whether the rays are similar enough for a packet to be efficient (measured
  /// with bench/intersect/, see src/scene/geometry/accel.h).
  LANELIGHT_INLINE bool IsNarrow(float reach) const {
    float spread = 0, extent = 0;
    for (int a = 0; a < 3; ++a) {
      spread = std::max(spread, d_max[a] - d_min[a]);
      extent = std::max(extent, o_max[a] - o_min[a]);
    }
    return spread <= kPacketSpread && extent <= kPacketExtent * reach;
  }
};

/// A packet prepared for the slab test. With s the common sign of d, plane b is met by a
/// ray at (s b - s o) / |d|. Over the packet that is at least min(x r_min, x r_max), x
/// the least s b - s o, and at most the corresponding maximum; x is grown by delta as in
/// SlabRay.
struct Frustum {
  V8 sign[3], near[3], far[3], r_min[3], r_max[3];
  int lower[3];
};

LANELIGHT_INLINE Frustum MakeFrustum(const PacketBounds& p, const Bvh& bvh) {
  const D8 d8;
  float largest = 0;
  for (int a = 0; a < 3; ++a) {
    largest = std::max({largest, std::abs(p.o_min[a]), std::abs(p.o_max[a])});
  }
  const float delta = bvh.margin + bvh.slack * largest;
  Frustum f;
  for (int a = 0; a < 3; ++a) {
    const bool negative = std::signbit(p.d_min[a]);
    const float small = std::max(negative ? -p.d_max[a] : p.d_min[a], 0x1p-80f);
    const float large = std::max(negative ? -p.d_min[a] : p.d_max[a], 0x1p-80f);
    f.sign[a] = hn::Set(d8, negative ? -1.0f : 1.0f);
    f.near[a] = hn::Set(d8, (negative ? p.o_min[a] : -p.o_max[a]) - delta);
    f.far[a] = hn::Set(d8, (negative ? p.o_max[a] : -p.o_min[a]) + delta);
    f.r_min[a] = hn::Set(d8, 1 / large);
    f.r_max[a] = hn::Set(d8, 1 / small);
    f.lower[a] = negative ? kBvhWidth : 0;
  }
  return f;
}

/// Returns the children that some ray of the packet may meet before t_max.
LANELIGHT_INLINE uint32_t HitChildren(const Frustum& f, const WideNode& node, float t_max,
                                      float* HWY_RESTRICT entry) {
  const D8 d8;
  uint32_t bits = 0;
  for (int i = 0; i < kBvhWidth; i += Lanes8()) {
    V8 enter = hn::Zero(d8), leave = hn::Set(d8, t_max);
    for (int a = 0; a < 3; ++a) {
      const float* planes = node.bounds[a][0] + i;
      const V8 x = hn::MulAdd(hn::Load(d8, planes + f.lower[a]), f.sign[a], f.near[a]);
      const V8 y = hn::MulAdd(hn::Load(d8, planes + (kBvhWidth - f.lower[a])), f.sign[a],
                              f.far[a]);
      enter = hn::Max(enter, hn::Min(hn::Mul(x, f.r_min[a]), hn::Mul(x, f.r_max[a])));
      leave = hn::Min(leave, hn::Max(hn::Mul(y, f.r_min[a]), hn::Mul(y, f.r_max[a])));
    }
    hn::Store(enter, d8, entry + i);
    bits |= MaskBits(d8, hn::Le(enter, leave)) << i;
  }
  return bits;
}

/// The rays of a packet in the space of a tree, their bounds there, and the rays in the
/// space of the scene.
struct FrustumRays {
  const Rays& rays;
  const PacketBounds& bounds;
  const Rays& home;
};

/// Visits the leaves of a tree that the packet meets, until no ray wants more, or until
/// `left`, which counts them down, is negative: then what was found is a bound.
template <bool kAny, bool kAlpha>
LANELIGHT_INLINE void TraceFrustum(const SceneParts& scene, const Bvh& bvh,
                                   const FrustumRays& of, int& left, PacketBest& best) {
  const DF df;
  const Rays& rays = of.rays;
  const uint32_t all = (1u << hn::Lanes(df)) - 1;
  const AxisOrder order(rays.d);
  PacketRays packet =
      MakePacket(rays, MakeShear(order, rays, Splat(bvh.reach)), order, all);
  if constexpr (kAlpha) packet.home = of.home;
  float bound = MaxLane(best.t);
  Traverse(scene.accel->nodes.data(), bvh.root, MakeFrustum(of.bounds, bvh), bound,
           [&](uint32_t ref) HWY_ATTR {
             if (--left < 0) return true;
             TestLeafPacket<kAny, kAlpha>(scene, ref, packet, all, best);
             bound = MaxLane(best.t);
             return bound < 0;
           });
}

/// Finds the closest hits of a batch and writes them to the columns. `left` is as in
/// TraceFrustum; if it is negative the rays must be traced in another way, from what the
/// columns hold now.
template <bool kAlpha>
LANELIGHT_INLINE void ClosestFrustum(const Wave& wave, const Rays& rays,
                                     const PacketBounds& bounds, const Slots& slots,
                                     int& left) {
  const Accel& accel = *wave.accel;
  PacketBest best = NoHits(rays.t_max, Gather(wave.path.prim, slots));
  TraceFrustum<false, kAlpha>(wave, accel.groups[0], {rays, bounds, rays}, left, best);
  best.Store(wave.path, slots);
}

/// Returns the rays of a batch that are blocked.
template <bool kAlpha>
LANELIGHT_INLINE MF BlockedFrustum(const SceneParts& scene, const Rays& rays,
                                   const PacketBounds& bounds) {
  PacketBest best = NoHits(rays.t_max, hn::Zero(DI()));
  int left = std::numeric_limits<int>::max();
  TraceFrustum<true, kAlpha>(scene, scene.accel->groups[0], {rays, bounds, rays}, left,
                             best);
  return MaskOf(DF(), best.found);
}

LANELIGHT_END_KERNELS

#endif
