// Rays in the spaces of instances. Distances are the same in all spaces, so that a hit in
// one culls in all.
#ifndef LANELIGHT_INTERSECT_INSTANCE_INL_H_
#define LANELIGHT_INTERSECT_INSTANCE_INL_H_

#include "kernels/intersect/rays-inl.h"
#include "kernels/simd/motion-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

/// Maps points or directions by the 3x4 matrices of instances, row by row.
LANELIGHT_INLINE V3 MapLanes(const VF m[12], V3 p, bool point) {
  const auto row = [&](const VF* r) HWY_ATTR {
    const VF last = hn::Mul(r[2], p.z), end = point ? hn::Add(last, r[3]) : last;
    return hn::Add(hn::Add(hn::Mul(r[0], p.x), hn::Mul(r[1], p.y)), end);
  };
  return {row(m), row(m + 4), row(m + 8)};
}

/// Rays of the scene's space, and the distances to beat, in the space of an instance.
LANELIGHT_INLINE Rays MapRays(const InstanceRecord& instance, V3 o, V3 d, VF t) {
  VF m[12];
  for (int k = 0; k < 12; ++k) m[k] = Splat(instance.object_from_scene[k]);
  return {MapLanes(m, o, true), MapLanes(m, d, false), t, FromNone()};
}

/// The rows of a map as MapLanes has them.
LANELIGHT_INLINE void PutRows(const Map34& map, VF m[12]) {
  const VF moves[3] = {map.move.x, map.move.y, map.move.z};
  for (int r = 0; r < 3; ++r) {
    m[4 * r] = map.row[r].x, m[4 * r + 1] = map.row[r].y, m[4 * r + 2] = map.row[r].z;
    m[4 * r + 3] = moves[r];
  }
}

/// Maps rays to the space of an instance that moves, at the times of the rays. Few
/// instances move, and entering them is far slower: not inlined.
HWY_NOINLINE inline Rays MapMovingRays(const MotionRecord& motion, const Rays& rays,
                                       VF time) {
  VF m[12];
  PutRows(SpaceAt(OneMotion{motion}, time).Back(), m);
  return {MapLanes(m, rays.o, true), MapLanes(m, rays.d, false), rays.t_max, FromNone()};
}

/// Replaces the maps to the objects of those lanes whose instances move.
HWY_NOINLINE inline void PutMovingMaps(const AlignedVector<MotionRecord>& motions,
                                       VI instance, VF time, VF m[12]) {
  const DI di;
  const auto count = hn::Set(di, static_cast<int32_t>(motions.size()));
  const auto moves = hn::Lt(instance, count);
  const RecordWords words(motions.data(), hn::IfThenElseZero(moves, instance));
  VF own[12];
  PutRows(SpaceAt(words, time).Back(), own);
  const MF mask = hn::RebindMask(DF(), moves);
  for (int k = 0; k < 12; ++k) m[k] = hn::IfThenElse(mask, own[k], m[k]);
}

/// The primitives that those of an instance must be smaller than at equal distances,
/// where (prim, inst) are the hits so far: between equal primitives the smaller instance
/// is nearer.
LANELIGHT_INLINE VI TieBreakPrimitives(VI prim, VI inst, uint32_t instance) {
  const DI di;
  const auto own = hn::Set(di, static_cast<int32_t>(instance));
  const auto world = hn::Eq(inst, hn::Set(di, static_cast<int32_t>(kWorldInstance)));
  const auto larger = hn::Or(world, hn::Lt(own, inst));
  const auto some = hn::Ne(prim, FromNone());
  return hn::Add(prim, hn::IfThenElseZero(hn::And(larger, some), hn::Set(di, 1)));
}

LANELIGHT_END_KERNELS

#endif
