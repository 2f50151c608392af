// A vector of coherent rays through the BVH together: the lanes are the rays in a leaf
// and the children in a node, where one slab test bounds all rays by intervals of origin
// and reciprocal direction (a frustum; Boulos, Wald and Benthin 2008). Which leaves are
// visited depends on the company of a ray, the hit does not.
#if defined(LANELIGHT_INTERSECT_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_PACKET_INL_H_
#undef LANELIGHT_INTERSECT_PACKET_INL_H_
#else
#define LANELIGHT_INTERSECT_PACKET_INL_H_
#endif

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/many-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE float LeastLane(VF v) { return hn::GetLane(hn::MinOfLanes(DF(), v)); }
HWY_INLINE float LargestLane(VF v) { return hn::GetLane(hn::MaxOfLanes(DF(), v)); }

/// Intervals of the rays of a packet, axis by axis.
struct PacketBounds {
  float o_min[3], o_max[3], d_min[3], d_max[3];

  /// Computed as far as needed: false as soon as the rays are found not to agree in the
  /// signs of their directions.
  HWY_INLINE bool Compute(const Rays& rays) {
    const DF df;
    const VF d[3] = {rays.d.x, rays.d.y, rays.d.z};
    const VF o[3] = {rays.o.x, rays.o.y, rays.o.z};
    for (const VF& v : d) {
      const MF negative =
          hn::RebindMask(df, hn::Lt(hn::BitCast(DI(), v), hn::Zero(DI())));
      if (!hn::AllTrue(df, negative) && !hn::AllFalse(df, negative)) return false;
    }
    for (int a = 0; a < 3; ++a) {
      d_min[a] = LeastLane(d[a]);
      d_max[a] = LargestLane(d[a]);
      o_min[a] = LeastLane(o[a]);
      o_max[a] = LargestLane(o[a]);
    }
    return true;
  }

  /// Whether the rays are close enough for a packet to pay: measured with
  /// bench/intersect.cc, see src/accel/accel.h.
  HWY_INLINE bool IsNarrow(float reach) const {
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

HWY_INLINE Frustum MakeFrustum(const PacketBounds& p, const Bvh& bvh) {
  const D8 d8;
  float reach = bvh.reach;
  float largest = 0;
  for (int a = 0; a < 3; ++a) {
    largest = std::max({largest, std::abs(p.o_min[a]), std::abs(p.o_max[a])});
  }
  const float delta = bvh.slack * (reach + largest);
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

/// Children that some ray of the packet may meet before t_max.
HWY_INLINE uint32_t HitChildren(const Frustum& f, const WideNode& node, float t_max,
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

/// The order of axes of a packet whose rays have the same largest axis.
struct CommonOrder {
  int x, y, z;

  HWY_INLINE P3<VF> Permute(V3 v) const {
    const VF axes[3] = {v.x, v.y, v.z};
    return {axes[x], axes[y], axes[z]};
  }
  HWY_INLINE P3<VF> Vertex(const float (*v)[kBvhWidth], int lane) const {
    return {Splat(v[x][lane]), Splat(v[y][lane]), Splat(v[z][lane])};
  }
};
/// The order of axes where rays differ.
struct LaneOrder {
  AxisOrder order;

  HWY_INLINE P3<VF> Permute(V3 v) const { return order.Permute(v); }
  HWY_INLINE P3<VF> Vertex(const float (*v)[kBvhWidth], int lane) const {
    return order.Permute({Splat(v[0][lane]), Splat(v[1][lane]), Splat(v[2][lane])});
  }
};

/// Calls found(hit, mask, prim) for the triangles of the leaves that the packet meets
/// while t_max() lets it; found returns the new bound of t, negative to end.
template <bool kAlpha, class Order, class TMax, class Found>
HWY_INLINE void TracePacket(const CompiledScene& scene, const Rays& rays,
                            const Frustum& frustum, const Order& order, TMax&& t_max,
                            Found&& found) {
  const DF df;
  const Bvh& bvh = scene.accel.groups[0];
  const Shear<VF> shear = MakeShear(order, rays, bvh.reach);
  float bound = LargestLane(t_max());
  const auto leaf = [&](uint32_t index) HWY_ATTR {
    const TriangleBlock& block = scene.accel.triangle_blocks[index];
    for (int i = 0; i < kBvhWidth && block.prim[i] != kEmptyRef; ++i) {
      const auto vertex = [&](int k) HWY_ATTR {
        return ShearVertex(df, shear, order.Vertex(block.v[k], i));
      };
      const auto is_ahead = [&](MF) HWY_ATTR {
        float p[3][3];
        for (int k = 0; k < 3; ++k) {
          for (int a = 0; a < 3; ++a) p[k][a] = block.v[k][a][i];
        }
        return AheadOf(rays, p[0], p[1], p[2]);
      };
      const TriangleHits<VF, MF> hit =
          TestTriangle(df, shear, vertex(0), vertex(1), vertex(2), t_max(), is_ahead);
      if (hn::AllFalse(df, hit.mask)) continue;
      MF mask = hit.mask;
      if constexpr (kAlpha) mask = CutOut(scene, rays, block.prim[i], hit, mask);
      bound = found(hit, mask, block.prim[i], bound);
      if (bound < 0) return true;
    }
    return false;
  };
  Traverse(scene.accel.nodes.data(), bvh.root, frustum, bound, leaf);
}

/// TracePacket with the cheaper order of axes that fits the rays.
template <bool kAlpha, class TMax, class Found>
HWY_INLINE void TraceAnyPacket(const CompiledScene& scene, const Rays& rays,
                               const PacketBounds& bounds, TMax&& t_max, Found&& found) {
  const DF df;
  const Frustum frustum = MakeFrustum(bounds, scene.accel.groups[0]);
  const LaneOrder lanes{AxisOrder(rays.d)};
  const bool all_z = hn::AllTrue(df, lanes.order.z),
             no_z = hn::AllFalse(df, lanes.order.z);
  const bool all_y = hn::AllTrue(df, lanes.order.y),
             no_y = hn::AllFalse(df, lanes.order.y);
  if (all_z || (no_z && (all_y || no_y))) {
    const int z = all_z ? 2 : all_y ? 1 : 0;
    const CommonOrder order{(z + 1) % 3, (z + 2) % 3, z};
    TracePacket<kAlpha>(scene, rays, frustum, order, t_max, found);
  } else {
    TracePacket<kAlpha>(scene, rays, frustum, lanes, t_max, found);
  }
}

/// Closest hits of a batch; hits are written to the columns.
template <bool kAlpha>
HWY_INLINE void ClosestPacket(const Wave& wave, const Rays& rays,
                              const PacketBounds& bounds, VI slots) {
  ManyClosest best(wave.path, rays, slots);
  TraceAnyPacket<kAlpha>(
      *wave.scene, rays, bounds, [&]() HWY_ATTR { return best.t(); },
      [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t id, float bound)
          HWY_ATTR { return best.Offer(hit, mask, id) ? LargestLane(best.t()) : bound; });
  best.Store(wave.path, slots);
}

/// Which rays of a batch are blocked.
template <bool kAlpha>
HWY_INLINE MF BlockedPacket(const CompiledScene& scene, const Rays& rays,
                            const PacketBounds& bounds) {
  const DF df;
  VF t_max = rays.t_max;  // -1 where the ray is blocked already
  TraceAnyPacket<kAlpha>(
      scene, rays, bounds, [&]() HWY_ATTR { return t_max; },
      [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t, float) HWY_ATTR {
        const MF blocked = hn::And(mask, hn::Lt(hit.t, t_max));
        t_max = hn::IfThenElse(blocked, Splat(-1.0f), t_max);
        return LargestLane(t_max);
      });
  return hn::Lt(t_max, hn::Zero(df));
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
