// The few shadow rays of a packet that are at one leaf, two at a time: the lanes are
// triangles. A packet's own test (packet_leaf-inl.h) costs as much for one of its rays as
// for all.
#ifndef LANELIGHT_INTERSECT_PACKET_SINGLES_INL_H_
#define LANELIGHT_INTERSECT_PACKET_SINGLES_INL_H_

#include <bit>

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/stream_lists-inl.h"
#include "kernels/intersect/stream_rays-inl.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

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
  LeafWeights weights[kTogether];
  uint32_t blocked = 0;
  while (lanes != 0) {
    LeafRay ray[kTogether];
    const Leaf* same[kTogether];
    LeafWeights* to[kTogether];
    uint32_t lane[kTogether], bits[kTogether];
    for (uint32_t j = 0; j < kTogether; ++j) {
      // The last one twice, if they are odd.
      lane[j] = lanes != 0 ? static_cast<uint32_t>(std::countr_zero(lanes)) : lane[0];
      lanes &= lanes - 1;
      ray[j] = place.rays.AtLeaf(place.at + lane[j]);
      same[j] = &leaf;
      to[j] = &weights[j];
    }
    TestLeaves(ray, same, to, bits);
    for (uint32_t j = 0; j < kTogether; ++j) {
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
