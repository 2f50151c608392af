// Shadow rays of a packet: the triangles that blocked the last ones, and tests of a few
// rays at a leaf by themselves.
#ifndef LANELIGHT_INTERSECT_PACKET_SHADOWS_INL_H_
#define LANELIGHT_INTERSECT_PACKET_SHADOWS_INL_H_

#include <algorithm>
#include <bit>

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/packet_leaf-inl.h"
#include "kernels/intersect/stream_lists-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// The triangles that blocked the last shadow rays of a wave. Rays from one part of a
/// scene to one light are often blocked by the same wall or table top: a packet is tested
/// against these first, each at about a fiftieth of the cost of tracing it.
template <bool kAlpha>
class LastBlockers {
 public:
  /// Remembers a triangle that blocked a ray, at the cost of the one known longest.
  LANELIGHT_INLINE void Add(uint32_t prim) {
    const uint32_t* const known = std::find(prim_, prim_ + count_, prim);
    if (known != prim_ + count_) return;
    count_ = std::min(count_ + 1, kMaxBlockers);
    for (uint32_t i = count_ - 1; i > 0; --i) prim_[i] = prim_[i - 1];
    prim_[0] = prim;
  }

  /// Finds the rays of `lanes` that these block, and forgets those that block none.
  LANELIGHT_INLINE void Test(const SceneParts& scene, const PacketRays& packet,
                             uint32_t lanes, PacketBest& best) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count_; ++i) {
      const uint32_t before = best.found;
      TestOne(scene, packet, prim_[i], lanes, best);
      prim_[kept] = prim_[i];
      kept += best.found != before;
    }
    count_ = kept;
  }

 private:
  static HWY_NOINLINE void TestOne(const SceneParts& scene, const PacketRays& packet,
                                   uint32_t prim, uint32_t lanes, PacketBest& best) {
    const DF df;
    const auto& p = scene.geometry->triangles[prim].p;
    const AxisOrder order(packet.rays.d);
    const auto corner = [&](int k) HWY_ATTR {
      const V3 v = Splat3(p[k][0], p[k][1], p[k][2]);
      return ShearVertex(df, packet.shear, order.Permute(v));
    };
    const MF tested = hn::And(MaskOf(df, lanes), ExcludesStart(packet.rays, prim));
    const TriangleHits<VF, MF> hit =
        TestTriangle(packet.shear, {corner(0), corner(1), corner(2)}, best.t, tested,
                     [&](MF) HWY_ATTR { return AheadOf(packet.rays, p[0], p[1], p[2]); });
    MF mask = hn::And(hit.mask, hn::Lt(hit.t, best.t));
    if constexpr (kAlpha) mask = CutOut(scene, packet.home, prim, hit, mask);
    best.found |= MaskBits(df, mask);
    best.t = hn::IfThenElse(mask, Splat(-1.0f), best.t);
  }

  static constexpr uint32_t kMaxBlockers = 4;
  uint32_t prim_[kMaxBlockers];  // the latest first
  uint32_t count_ = 0;
};

// The few shadow rays of a packet that are at one leaf, two at a time: the lanes are
// triangles. A packet's own test (packet_leaf-inl.h) costs as much for one of its rays as
// for all.

/// At most so many shadow rays of a packet are tested by themselves at a leaf of separate
/// triangles, where a packet shears three vertices for each. At other leaves, and for
/// closest hits, branches that cannot be predicted cost more than is saved
/// (docs/intersect.md).
inline constexpr int kSingleRays = StreamRays::kLanes >= 8 ? 6 : 2;

/// The rays of a packet at [at, at + lanes), and those in the space of the scene, for
/// which cut-outs are decided, at `home`.
struct PacketPlace {
  const StreamRays& rays;
  uint32_t at, home;
};

/// The first of the triangles of `bits`, which the line of the ray at `place` passes
/// through, that blocks it; kNoPrimitive if none does.
template <bool kAlpha, class Leaf>
HWY_NOINLINE uint32_t BlockerOf(const SceneParts& scene, const PacketPlace& place,
                                const Leaf& leaf, const LeafWeights& weights,
                                uint32_t bits) {
  const StreamRays& rays = place.rays;
  const auto copy_from = [&](uint32_t r, float o[3], float d[3]) HWY_ATTR {
    for (int a = 0; a < 3; ++a) o[a] = rays.o[a][r], d[a] = rays.d[a][r];
  };
  const uint32_t r = place.at;
  for (; bits != 0; bits &= bits - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(bits));
    LaneHit hit;
    const bool ahead = FinishLane(
        leaf, weights, i, rays.shear_o[r].t_scale,
        [&](float o[3], float d[3]) HWY_ATTR { copy_from(r, o, d); }, hit);
    const bool before_end = hit.t < rays.t[r];
    if (!(ahead & before_end)) continue;
    if constexpr (kAlpha) {
      float o[3], d[3];
      copy_from(place.home, o, d);
      const float b1 = hit.v / hit.det, b2 = hit.w / hit.det;
      if (!TrianglePassesAlpha(scene, o, d, {leaf.prim[i], b1, b2})) continue;
    }
    return leaf.prim[i];
  }
  return kNoPrimitive;
}

/// As TestLeafPacket; `lanes` are not blocked yet.
template <bool kAlpha, class Leaf>
LANELIGHT_INLINE void TestLeafSingles(const SceneParts& scene, const Leaf& leaf,
                                      const PacketPlace& place, uint32_t lanes,
                                      PacketBest& best) {
  LeafWeights weights[kInterleavedRays];
  uint32_t blocked = 0;
  while (lanes != 0) {
    LeafRay ray[kInterleavedRays];
    const Leaf* same[kInterleavedRays];
    LeafWeights* to[kInterleavedRays];
    uint32_t lane[kInterleavedRays], bits[kInterleavedRays];
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      // The last one twice, if they are odd.
      lane[j] = lanes != 0 ? static_cast<uint32_t>(std::countr_zero(lanes)) : lane[0];
      lanes &= lanes - 1;
      ray[j] = place.rays.AtLeaf(place.at + lane[j]);
      same[j] = &leaf;
      to[j] = &weights[j];
    }
    TestLeaves(ray, same, to, bits);
    for (uint32_t j = 0; j < kInterleavedRays; ++j) {
      if (bits[j] == 0) continue;
      const PacketPlace own = {place.rays, place.at + lane[j], place.home + lane[j]};
      const uint32_t blocker = BlockerOf<kAlpha>(scene, own, leaf, weights[j], bits[j]);
      if (blocker == kNoPrimitive) continue;
      best.blocker = blocker;
      blocked |= 1u << lane[j];
    }
  }
  best.found |= blocked;
  best.t = hn::IfThenElse(MaskOf(DF(), blocked), Splat(-1.0f), best.t);
}

LANELIGHT_END_KERNELS

#endif
