// A vector of coherent rays through the world and instances: a frustum in each space.
#ifndef LANELIGHT_INTERSECT_PACKET_INSTANCES_INL_H_
#define LANELIGHT_INTERSECT_PACKET_INSTANCES_INL_H_

#include "kernels/intersect/instance-inl.h"
#include "kernels/intersect/packet-inl.h"

LANELIGHT_BEGIN_KERNELS

/// The hits of a packet so far, and the instances that they are on.
struct InstancedBest {
  PacketBest hit;
  VI inst;

  /// Takes those that were found in an instance.
  LANELIGHT_INLINE void Take(const PacketBest& own, uint32_t instance) {
    const DI di;
    const MF mask = MaskOf(DF(), own.found);
    const auto lanes = hn::RebindMask(di, mask);
    hit.found |= own.found;
    hit.t = hn::IfThenElse(mask, own.t, hit.t);
    hit.prim = hn::IfThenElse(lanes, own.prim, hit.prim);
    hit.v = hn::IfThenElse(mask, own.v, hit.v);
    hit.w = hn::IfThenElse(mask, own.w, hit.w);
    hit.det = hn::IfThenElse(mask, own.det, hit.det);
    inst = hn::IfThenElse(lanes, hn::Set(di, static_cast<int32_t>(instance)), inst);
  }
};

struct PacketOfPaths {
  const Wave& wave;
  const Rays& rays;
  const Slots& slots;

  /// In the space of an instance, where distances below `t` matter. kMoving: some move.
  template <bool kMoving>
  LANELIGHT_INLINE Rays In(uint32_t instance, VF t) const {
    const Geometry& geometry = *wave.geometry;
    if (kMoving && instance < geometry.motions.size()) {
      return MapMovingRays(geometry.motions[instance], {rays.o, rays.d, t, FromNone()},
                           Gather(wave.path.time, slots));
    }
    return MapRays(geometry.instances[instance], rays.o, rays.d, t);
  }
};

/// Traces a packet through an instance as TraceFrustum does. There, too, its rays must
/// agree in the signs of their directions: if they do not, `left` becomes negative.
template <bool kAlpha, bool kMoving>
HWY_NOINLINE void TraceInstance(const PacketOfPaths& paths, uint32_t instance, int& left,
                                InstancedBest& best) {
  const SceneParts& scene = paths.wave;
  const Geometry& geometry = *scene.geometry;
  const Rays own = paths.In<kMoving>(instance, best.hit.t);
  PacketBounds bounds;
  if (!bounds.Compute(own)) {
    left = -1;
    return;
  }
  PacketBest hit =
      NoHits(best.hit.t, TieBreakPrimitives(best.hit.prim, best.inst, instance));
  TraceFrustum<false, kAlpha>(scene,
                              scene.accel->groups[geometry.instance_group[instance]],
                              {own, bounds, paths.rays}, left, hit);
  best.Take(hit, instance);
}

/// Does what ClosestFrustum does, in scenes with instances.
template <bool kAlpha>
LANELIGHT_INLINE void ClosestFrustumInstanced(const Wave& wave, const Rays& rays,
                                              const PacketBounds& bounds,
                                              const Slots& slots, int& left) {
  const SceneParts& scene = wave;
  const Accel& accel = *scene.accel;
  InstancedBest best = {NoHits(rays.t_max, Gather(wave.path.prim, slots)),
                        hn::Set(DI(), static_cast<int32_t>(kWorldInstance))};
  if (accel.groups[0].root != kEmptyRef) {
    TraceFrustum<false, kAlpha>(scene, accel.groups[0], {rays, bounds, rays}, left,
                                best.hit);
  }
  float bound = MaxLane(best.hit.t);
  if (left >= 0) {
    const PacketOfPaths paths = {wave, rays, slots};
    const bool moving = !scene.geometry->motions.empty();
    Traverse(accel.nodes.data(), accel.top.root, MakeFrustum(bounds, accel.top), bound,
             [&](uint32_t instance) HWY_ATTR {
               moving ? TraceInstance<kAlpha, true>(paths, instance, left, best)
                      : TraceInstance<kAlpha, false>(paths, instance, left, best);
               bound = MaxLane(best.hit.t);
               return left < 0;
             });
  }
  best.hit.Store(wave.path, slots);
  const auto found = hn::RebindMask(DI(), MaskOf(DF(), best.hit.found));
  Scatter(hn::IfThenElse(found, best.inst, Gather(wave.path.inst, slots)), wave.path.inst,
          slots);
}

LANELIGHT_END_KERNELS

#endif
