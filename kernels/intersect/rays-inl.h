// Reads rays from the path columns and writes hits, or the surviving shadow rays, back.
#ifndef LANELIGHT_INTERSECT_RAYS_INL_H_
#define LANELIGHT_INTERSECT_RAYS_INL_H_

#include <limits>

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

/// The columns of a closest-hit query. t is an upper bound, initially +inf; a nearer hit
/// lowers it and sets prim, b1, b2 and inst. Equal distances go to the smaller primitive
/// id. While t is +inf there is no hit; prim then is the primitive that the ray starts on
/// (kNoPrimitive: none), which triangles leave out.
inline constexpr FieldSet kClosestRay = fields::kRay | FieldSet{Field::t};

/// The columns of a shadow ray: offset origin, direction and length. Blocked rays leave
/// the queue, the others keep their order.
inline constexpr FieldSet kShadowRay =
    fields::kPoint | FieldSet{Field::ng_x, Field::ng_y, Field::ng_z,       Field::ls_x,
                              Field::ls_y, Field::ls_z, Field::ls_distance};

/// One vector of rays. `t_max` is the distance to beat (closest hit: a candidate at t_max
/// still wins with a smaller id) or the exclusive end (shadow). `from` is the primitive
/// that the ray starts on, kNoPrimitive if there is none or it is not known: if it is a
/// triangle of the world it is left out, since a ray that starts beside the plane of a
/// triangle, and away from it, cannot meet it.
struct Rays {
  V3 o, d;
  VF t_max;
  VI from;
};

/// The rays of a vector as arrays.
struct RayArrays {
  HWY_ALIGN float o[3][hn::MaxLanes(DF())];
  HWY_ALIGN float d[3][hn::MaxLanes(DF())];
  HWY_ALIGN float t_max[hn::MaxLanes(DF())];
  HWY_ALIGN uint32_t slot[hn::MaxLanes(DF())];

  LANELIGHT_INLINE RayArrays(const Rays& rays, VI slots) {
    const DF df;
    hn::Store(rays.o.x, df, o[0]);
    hn::Store(rays.o.y, df, o[1]);
    hn::Store(rays.o.z, df, o[2]);
    hn::Store(rays.d.x, df, d[0]);
    hn::Store(rays.d.y, df, d[1]);
    hn::Store(rays.d.z, df, d[2]);
    hn::Store(rays.t_max, df, t_max);
    hn::Store(hn::BitCast(DU(), slots), DU(), slot);
  }
};

/// Calls each(i, arrays, o, d) for the valid rays of a batch one by one.
template <class Each>
LANELIGHT_INLINE void ForEachRay(const Rays& batch, VI slots, MF valid, Each&& each) {
  const RayArrays rays(batch, slots);
  const int count = static_cast<int>(hn::CountTrue(DF(), valid));
  for (int i = 0; i < count; ++i) {
    const float o[3] = {rays.o[0][i], rays.o[1][i], rays.o[2][i]};
    const float d[3] = {rays.d[0][i], rays.d[1][i], rays.d[2][i]};
    each(i, rays, o, d);
  }
}

LANELIGHT_INLINE VI FromNone() {
  return hn::Set(DI(), static_cast<int32_t>(kNoPrimitive));
}

/// Rays::from of extension rays: `prim` is that of the last hit until there is a new one.
LANELIGHT_INLINE VI StartsOf(const PathColumns& path, const Slots& slots, VF t) {
  const auto fresh = hn::RebindMask(DI(), hn::IsInf(t));
  return hn::IfThenElse(fresh, Gather(path.prim, slots), FromNone());
}

/// Loads the extension rays of a batch (queue kActive).
LANELIGHT_INLINE Rays LoadRays(const PathColumns& path, const Slots& slots) {
  return {Gather3(path.o_x, path.o_y, path.o_z, slots),
          Gather3(path.d_x, path.d_y, path.d_z, slots), Gather(path.t, slots),
          FromNone()};
}

/// Loads the shadow rays of a batch (queue kShadow).
LANELIGHT_INLINE Rays LoadShadowRays(const PathColumns& path, const Slots& slots) {
  const V3 p = Gather3(path.p_x, path.p_y, path.p_z, slots);
  const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
  const V3 d = Gather3(path.ls_x, path.ls_y, path.ls_z, slots);
  return {OffsetOrigin(p, ng, Gather(path.p_error, slots), d), d,
          Gather(path.ls_distance, slots), FromNone()};
}

/// Writes the lanes of `closer`; the others keep what they have.
template <bool kInstances>
LANELIGHT_INLINE void StoreRoundHits(const PathColumns& path, const Slots& slots,
                                     MF closer, VF t, VI prim) {
  const DI di;
  const auto mask = hn::RebindMask(di, closer);
  Scatter(hn::IfThenElse(closer, t, Gather(path.t, slots)), path.t, slots);
  Scatter(hn::IfThenElse(mask, prim, Gather(path.prim, slots)), path.prim, slots);
  if constexpr (kInstances) {
    Scatter(hn::IfThenElse(mask, hn::Set(di, -1), Gather(path.inst, slots)), path.inst,
            slots);
  }
}

/// Lanes where (t, prim) is nearer than the best, or as near with a smaller id.
LANELIGHT_INLINE MF IsCloser(VF t, VI prim, VF best_t, VI best_prim) {
  const DF df;
  const MF smaller = hn::RebindMask(df, hn::Lt(prim, best_prim));
  return hn::Or(hn::Lt(t, best_t), hn::And(hn::Eq(t, best_t), smaller));
}

/// Calls occluded(rays, slots, valid) -> MF for each vector of shadow rays and keeps only
/// the others in the queue, in order. Storing at or before the place just read is safe:
/// a compressed store touches one vector, all of which has been read.
template <class Occluded>
LANELIGHT_INLINE void RemoveOccluded(Wave& wave, Occluded&& occluded) {
  const Queue all = wave.queue(QueueId::kShadow);
  Queue& kept = wave.queue(QueueId::kShadow);
  kept.size = 0;
  ForEachBatch(wave, all, [&](const Slots& slots, MF valid) HWY_ATTR {
    const MF blocked = occluded(LoadShadowRays(wave.path, slots), slots, valid);
    Push(kept, slots, hn::AndNot(blocked, valid));
  });
}

/// As SlabRay, each lane a ray. Bit a of `octant` is set where the direction is negative
/// along axis a, which `negative[a]` says as a mask.
struct PacketSlabs {
  VF rcp[3], near[3], far[3];
  MF negative[3];
  VI octant;

  /// Uses the arithmetic of MakeSlabRay, and grows boxes as Bvh does.
  LANELIGHT_INLINE PacketSlabs(V3 ray_o, V3 ray_d, VF slack, VF margin) {
    const DF df;
    const DI di;
    const VF o[3] = {ray_o.x, ray_o.y, ray_o.z}, d[3] = {ray_d.x, ray_d.y, ray_d.z};
    const VF largest = hn::Max(hn::Abs(o[0]), hn::Max(hn::Abs(o[1]), hn::Abs(o[2])));
    const VF delta = hn::MulAdd(slack, largest, margin);
    const VF minimum = Splat(0x1p-80f);
    octant = hn::Zero(di);
    for (int a = 0; a < 3; ++a) {
      const MF tiny = hn::Lt(hn::Abs(d[a]), minimum);
      const VF da = hn::IfThenElse(tiny, hn::CopySign(minimum, d[a]), d[a]);
      const VF r = hn::Div(Splat(1.0f), da);
      const VF c = hn::Neg(hn::Mul(o[a], r)), grow = hn::Mul(delta, hn::Abs(r));
      rcp[a] = r;
      near[a] = hn::Sub(c, grow);
      far[a] = hn::Add(c, grow);
      negative[a] = hn::Lt(da, hn::Zero(df));
      octant = hn::Or(octant, OfNegative(a, 1 << a));
    }
  }

  /// Returns `value` in the lanes whose direction is negative along axis a, else 0.
  LANELIGHT_INLINE VI OfNegative(int a, int32_t value) const {
    const DI di;
    return hn::IfThenElseZero(hn::RebindMask(di, negative[a]), hn::Set(di, value));
  }

  /// Returns the lanes that are rays. A NaN or infinite one must enter nothing: Min and
  /// Max of NaN differ between targets, and unused children must not be entered.
  LANELIGHT_INLINE MF Finite() const {
    return hn::IsFinite(hn::Add(near[0], hn::Add(near[1], near[2])));
  }

  /// Makes lanes that are no rays leave all slabs before they enter them.
  LANELIGHT_INLINE void CloseOthers() {
    const MF ray = Finite();
    if (HWY_LIKELY(hn::AllTrue(DF(), ray))) return;
    const VF never = Splat(std::numeric_limits<float>::infinity());
    for (int a = 0; a < 3; ++a) {
      rcp[a] = hn::IfThenElse(ray, rcp[a], Splat(1.0f));
      near[a] = hn::IfThenElse(ray, near[a], never);
      far[a] = hn::IfThenElse(ray, far[a], hn::Neg(never));
    }
  }
};

LANELIGHT_END_KERNELS

#endif
