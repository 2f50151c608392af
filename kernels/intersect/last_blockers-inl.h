// The triangles that blocked the last shadow rays of a wave. Rays from one part of a
// scene to one light are often blocked by the same wall or table top: a packet is tested
// against these first, each at about a fiftieth of the cost of tracing it.
#ifndef LANELIGHT_INTERSECT_LAST_BLOCKERS_INL_H_
#define LANELIGHT_INTERSECT_LAST_BLOCKERS_INL_H_

#include <algorithm>

#include "kernels/intersect/packet_leaf-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

template <bool kAlpha>
class LastBlockers {
 public:
  /// Remembers a triangle that blocked a ray, at the cost of the one known longest.
  LANELIGHT_INLINE void Add(uint32_t prim) {
    const uint32_t* const known = std::find(prim_, prim_ + count_, prim);
    if (known != prim_ + count_) return;
    count_ = std::min(count_ + 1, kMost);
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
    const MF tested = hn::And(MaskOf(df, lanes), NotFrom(packet.rays, prim));
    const TriangleHits<VF, MF> hit =
        TestTriangle(packet.shear, {corner(0), corner(1), corner(2)}, best.t, tested,
                     [&](MF) HWY_ATTR { return AheadOf(packet.rays, p[0], p[1], p[2]); });
    MF mask = hn::And(hit.mask, hn::Lt(hit.t, best.t));
    if constexpr (kAlpha) mask = CutOut(scene, packet.home, prim, hit, mask);
    best.found |= MaskBits(df, mask);
    best.t = hn::IfThenElse(mask, Splat(-1.0f), best.t);
  }

  static constexpr uint32_t kMost = 4;
  uint32_t prim_[kMost];  // the latest first
  uint32_t count_ = 0;
};

LANELIGHT_END_KERNELS

#endif
