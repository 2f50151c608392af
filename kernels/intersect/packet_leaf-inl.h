// A vector of rays against the triangles of a leaf: the lanes are rays.
#ifndef LANELIGHT_INTERSECT_PACKET_LEAF_INL_H_
#define LANELIGHT_INTERSECT_PACKET_LEAF_INL_H_

#include <bit>

#include "kernels/intersect/beam-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// Rays of a packet prepared for leaves. `same_axes`: the order of axes is `axis[]` for
/// all of them. `has_beam`: moreover they are similar, and `beam` bounds them.
struct PacketRays {
  Rays rays;
  Shear<VF> shear;
  bool same_axes = false, has_beam = false;
  uint32_t axis[3] = {};
  Beam beam = {};
  Rays home = rays;  // in the space of the scene, which decides about cut-outs
};

/// Prepares rays for leaves; `valid`: their lanes, as bits.
LANELIGHT_INLINE PacketRays MakePacket(const Rays& rays, const Shear<VF>& shear,
                                       const AxisOrder& order, uint32_t valid) {
  PacketRays packet{rays, shear};
  const uint32_t y = MaskBits(DF(), order.y) & valid, z = MaskBits(DF(), order.z) & valid;
  packet.same_axes = z == valid || (z == 0 && (y == valid || y == 0));
  packet.axis[2] = z != 0 ? 2 : y != 0 ? 1 : 0;
  packet.axis[0] = (packet.axis[2] + 1) % 3;
  packet.axis[1] = (packet.axis[2] + 2) % 3;
  // The lanes behind the last ray of a stream may hold anything.
  const bool full = valid == (1u << hn::MaxLanes(DF())) - 1;
  if (!packet.same_axes || !full) return packet;
  packet.beam = MakeBeam(shear);
  packet.has_beam = packet.beam.IsNarrow();
  return packet;
}

/// Three numbers for each ray and each vertex, or each triangle, of a leaf.
template <int kRows>
class PacketColumns {
 public:
  LANELIGHT_INLINE void Keep(uint32_t i, P3<VF> p) {
    const DF df;
    hn::Store(p.x, df, x_[i]);
    hn::Store(p.y, df, y_[i]);
    hn::Store(p.z, df, z_[i]);
  }
  LANELIGHT_INLINE P3<VF> operator[](uint32_t i) const {
    const DF df;
    return {hn::Load(df, x_[i]), hn::Load(df, y_[i]), hn::Load(df, z_[i])};
  }

 private:
  // Three arrays, so that an address is a row shifted by a constant: packets 4 to 10 %
  // faster than with [row][3].
  HWY_ALIGN float x_[kRows][hn::MaxLanes(DF())];
  HWY_ALIGN float y_[kRows][hn::MaxLanes(DF())];
  HWY_ALIGN float z_[kRows][hn::MaxLanes(DF())];
};

/// Calls f(i) for the vertices of some triangles of a leaf, or more.
template <int n, class F>
LANELIGHT_INLINE void ForEachVertex(const SharedLeaf<n>& leaf, uint32_t, F&& f) {
  for (uint32_t i = 0; i < leaf.vertices; ++i) f(i);
}
template <class F>
LANELIGHT_INLINE void ForEachVertex(const SeparateLeaf& leaf, uint32_t triangles, F&& f) {
  for (; triangles != 0; triangles &= triangles - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(triangles));
    for (int k = 0; k < 3; ++k) f(leaf.VertexOf(k, i));
  }
}

/// The vertices of some triangles of a leaf as each ray sees them.
template <class Leaf>
LANELIGHT_INLINE void ShearLeaf(const Leaf& leaf, uint32_t triangles,
                                const PacketRays& packet,
                                PacketColumns<Leaf::kVertexLanes>& to) {
  const DF df;
  if (packet.same_axes) {
    const float *x = leaf.vertex[packet.axis[0]], *y = leaf.vertex[packet.axis[1]],
                *z = leaf.vertex[packet.axis[2]];
    ForEachVertex(leaf, triangles, [&](uint32_t i) HWY_ATTR {
      const P3<VF> p = {Splat(x[i]), Splat(y[i]), Splat(z[i])};
      to.Keep(i, ShearVertex(df, packet.shear, p));
    });
    return;
  }
  const AxisOrder order(packet.rays.d);
  ForEachVertex(leaf, triangles, [&](uint32_t i) HWY_ATTR {
    const V3 p = Splat3(leaf.vertex[0][i], leaf.vertex[1][i], leaf.vertex[2][i]);
    to.Keep(i, ShearVertex(df, packet.shear, order.Permute(p)));
  });
}

/// Tests the rays of `lanes` against a leaf. A first pass finds the triangles that any of
/// their lines passes through; its tests have no branches, and what it computes is kept,
/// so that tests overlap in both passes.
template <bool kAny, bool kAlpha, class Leaf>
LANELIGHT_INLINE void TestLeafPacket(const SceneParts& scene, const Leaf& leaf,
                                     const PacketRays& packet, uint32_t lanes,
                                     PacketBest& best) {
  const DF df;
  uint32_t near =
      packet.has_beam ? TrianglesInBeam(packet.beam, leaf, packet.axis) : UsedLanes(leaf);
  if (near == 0) return;
  PacketColumns<Leaf::kVertexLanes> vertices;
  ShearLeaf(leaf, near, packet, vertices);
  const auto corner = [&](uint32_t i, int k)
                          HWY_ATTR { return vertices[leaf.VertexOf(k, i)]; };
  PacketColumns<Leaf::kLanes> weights;
  uint32_t passed = 0;
  for (; near != 0; near &= near - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(near));
    const P3<VF> p = corner(i, 0), q = corner(i, 1), r = corner(i, 2);
    MF mask = ExcludesStart(packet.rays, leaf.prim[i]);
    if constexpr (kCheapEdges) {
      const P3<VF> edges = EdgesOf(df, p, q, r);
      weights.Keep(i, edges);
      mask = hn::And(HaveOneSign(df, edges), mask);
    } else {
      mask = hn::And(MayPassEdges(df, p, q, r), mask);
    }
    passed |= uint32_t{(lanes & MaskBits(df, mask)) != 0} << i;
  }
  const MF active = MaskOf(df, lanes);
  for (; passed != 0; passed &= passed - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(passed));
    const auto is_ahead = [&](MF) HWY_ATTR {
      float p[3][3];
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) p[k][a] = leaf.vertex[a][leaf.VertexOf(k, i)];
      }
      return AheadOf(packet.rays, p[0], p[1], p[2]);
    };
    const Corners<VF> at = {corner(i, 0), corner(i, 1), corner(i, 2)};
    auto edges = kCheapEdges ? JoinEdges(df, weights[i]) : TestEdges(df, at);
    edges.mask =
        hn::And(hn::And(edges.mask, active), ExcludesStart(packet.rays, leaf.prim[i]));
    TestDistance(df, packet.shear, at, best.t, edges);
    if (hn::AllFalse(df, edges.mask)) continue;
    TriangleHits<VF, MF> hit = FinishHits(df, packet.shear, at, edges, is_ahead);
    MF mask = hit.mask;
    if constexpr (kAlpha) mask = CutOut(scene, packet.home, leaf.prim[i], hit, mask);
    if constexpr (kAny) {
      mask = hn::And(mask, hn::Lt(hit.t, best.t));
      const uint32_t blocked = MaskBits(df, mask);
      best.found |= blocked;
      best.blocker = blocked != 0 ? leaf.prim[i] : best.blocker;
      best.t = hn::IfThenElse(mask, Splat(-1.0f), best.t);
    } else {
      best.AcceptNearer(hit, mask, leaf.prim[i]);
    }
  }
}

/// Calls test(leaf) for the leaf that a reference names.
template <class Test>
LANELIGHT_INLINE void WithLeaf(const SceneParts& scene, uint32_t ref, Test&& test) {
  const LeafPlaces leaves(*scene.accel);
  if (HWY_UNLIKELY(ref & kSeparateBit)) return test(leaves.Of<SeparateLeaf>(ref));
  if (leaves.small()) return test(leaves.Of<SmallLeaf>(ref));
  test(leaves.Of<TriangleLeaf>(ref));
}

/// TestLeafPacket for the leaf that a reference names.
template <bool kAny, bool kAlpha>
LANELIGHT_INLINE void TestLeafPacket(const SceneParts& scene, uint32_t ref,
                                     const PacketRays& packet, uint32_t lanes,
                                     PacketBest& best) {
  WithLeaf(scene, ref, [&](const auto& leaf) HWY_ATTR {
    TestLeafPacket<kAny, kAlpha>(scene, leaf, packet, lanes, best);
  });
}

LANELIGHT_END_KERNELS

#endif
