// Many rays, one per lane, against one triangle: what the kernels for small scenes and
// for coherent rays share.
#ifndef LANELIGHT_INTERSECT_MANY_INL_H_
#define LANELIGHT_INTERSECT_MANY_INL_H_

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/triangle-inl.h"
#include "kernels/simd/lanes-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

/// Lane-wise choice of the axis along which the direction is largest: x unless |y| is
/// larger, z if |z| is larger than both.
struct AxisOrder {
  MF y, z;

  LANELIGHT_INLINE explicit AxisOrder(V3 d) {
    const VF ax = hn::Abs(d.x), ay = hn::Abs(d.y), az = hn::Abs(d.z);
    y = hn::Gt(ay, ax);
    z = hn::Gt(az, hn::Max(ax, ay));
  }
  /// Cyclic permutation that brings the largest axis last.
  LANELIGHT_INLINE P3<VF> Permute(V3 v) const {
    return {hn::IfThenElse(z, v.x, hn::IfThenElse(y, v.z, v.y)),
            hn::IfThenElse(z, v.y, hn::IfThenElse(y, v.x, v.z)),
            hn::IfThenElse(z, v.z, hn::IfThenElse(y, v.y, v.x))};
  }
};

template <class Order>
LANELIGHT_INLINE Shear<VF> MakeShear(const Order& order, const Rays& rays, VF reach) {
  Shear<VF> shear;
  shear.o = order.Permute(rays.o);
  const P3<VF> d = order.Permute(rays.d);
  shear.s = {hn::Div(d.x, d.z), hn::Div(d.y, d.z), hn::Div(Splat(1.0f), d.z)};
  shear.abs_dz = hn::Abs(d.z);
  const VF r = hn::Add(
      reach, MaxComponent({hn::Abs(rays.o.x), hn::Abs(rays.o.y), hn::Abs(rays.o.z)}));
  shear.t_scale =
      hn::Div(hn::Mul(hn::Mul(hn::Mul(Splat(0x1p-13f), r), r), r), shear.abs_dz);
  return shear;
}

/// Lanes whose ray has the plane of triangle (v0, v1, v2) ahead: PlaneIsAhead for many
/// rays, with the same order of operations.
inline HWY_NOINLINE MF AheadOf(const Rays& rays, const float v0[3], const float v1[3],
                               const float v2[3]) {
  const DF df;
  double n[3];
  ExactNormal(v0, v1, v2, n);
  const auto side = [&](auto dd, auto ox, auto oy, auto oz, auto dx, auto dy,
                        auto dz) HWY_ATTR {
    const auto nx = hn::Set(dd, n[0]), ny = hn::Set(dd, n[1]), nz = hn::Set(dd, n[2]);
    const auto zero = hn::Zero(dd), one = hn::Set(dd, 1.0);
    const auto sign = [&](auto x, auto y, auto z) HWY_ATTR {
      const auto sum = hn::Add(hn::Add(hn::Mul(nx, x), hn::Mul(ny, y)), hn::Mul(nz, z));
      return hn::IfThenElse(hn::Gt(sum, zero), one,
                            hn::IfThenElse(hn::Lt(sum, zero), hn::Neg(one), zero));
    };
    const auto distance = sign(hn::Sub(hn::Set(dd, double{v0[0]}), ox),
                               hn::Sub(hn::Set(dd, double{v0[1]}), oy),
                               hn::Sub(hn::Set(dd, double{v0[2]}), oz));
    return hn::Mul(distance, sign(dx, dy, dz));
  };
  const VF same =
      InDouble(df, side, rays.o.x, rays.o.y, rays.o.z, rays.d.x, rays.d.y, rays.d.z);
  return hn::Gt(same, hn::Zero(df));
}

/// Returns the lanes whose ray does not start on triangle `prim`.
LANELIGHT_INLINE MF ExcludesStart(const Rays& rays, uint32_t prim) {
  return hn::RebindMask(DF(),
                        hn::Ne(rays.from, hn::Set(DI(), static_cast<int32_t>(prim))));
}

/// Clears the lanes of `mask` whose candidate hit on `prim` is cut out.
LANELIGHT_INLINE MF CutOut(const SceneParts& scene, const Rays& rays, uint32_t prim,
                           const TriangleHits<VF, MF>& hit, MF mask) {
  const DF df;
  if (!(scene.geometry->triangles[prim].flags & kAlphaTested)) return mask;
  const RayArrays ray(rays, hn::Zero(DI()));
  HWY_ALIGN float b1[hn::MaxLanes(DF())], b2[hn::MaxLanes(DF())];
  hn::Store(hn::Div(hit.v, hit.det), df, b1);
  hn::Store(hn::Div(hit.w, hit.det), df, b2);
  uint32_t kept = 0;
  for (uint32_t bits = MaskBits(df, mask); bits != 0; bits &= bits - 1) {
    const int i = std::countr_zero(bits);
    const float o[3] = {ray.o[0][i], ray.o[1][i], ray.o[2][i]};
    const float d[3] = {ray.d[0][i], ray.d[1][i], ray.d[2][i]};
    if (TrianglePassesAlpha(scene, o, d, {prim, b1[i], b2[i]})) kept |= 1u << i;
  }
  return MaskOf(df, kept);
}

/// The hits of a vector of rays so far. In a shadow query t is the end of each ray, and
/// negative once the ray is blocked.
struct PacketBest {
  VF t;
  VI prim;
  VF v, w, det;                     // weights of vertices 1 and 2 times det
  uint32_t found;                   // lanes, as bits
  uint32_t blocker = kNoPrimitive;  // in a shadow query: a triangle that blocks a ray

  /// Takes over the lanes of `mask` where the hit on `id` is closer.
  LANELIGHT_INLINE void AcceptNearer(const TriangleHits<VF, MF>& hit, MF mask,
                                     uint32_t id) {
    const DF df;
    const DI di;
    const VI own = hn::Set(di, static_cast<int32_t>(id));
    const MF closer = hn::And(mask, IsCloser(hit.t, own, t, prim));
    found |= MaskBits(df, closer);
    t = hn::IfThenElse(closer, hit.t, t);
    prim = hn::IfThenElse(hn::RebindMask(di, closer), own, prim);
    v = hn::IfThenElse(closer, hit.v, v);
    w = hn::IfThenElse(closer, hit.w, w);
    det = hn::IfThenElse(closer, hit.det, det);
  }
  /// Writes the hits to the columns.
  LANELIGHT_INLINE void Store(const PathColumns& path, const Slots& slots) const {
    const MF any = MaskOf(DF(), found);
    const VF b1 = hn::Div(v, det), b2 = hn::Div(w, det);
    Scatter(t, path.t, slots);
    Scatter(prim, path.prim, slots);
    Scatter(hn::IfThenElse(any, b1, Gather(path.b1, slots)), path.b1, slots);
    Scatter(hn::IfThenElse(any, b2, Gather(path.b2, slots)), path.b2, slots);
  }
};

LANELIGHT_INLINE PacketBest NoHits(VF t_max, VI prim) {
  return {t_max, prim, hn::Zero(DF()), hn::Zero(DF()), Splat(1.0f), 0};
}

LANELIGHT_END_KERNELS

#endif
