// A vector of rays prepared for the slab tests of a tree.
#ifndef LANELIGHT_INTERSECT_SLABS_INL_H_
#define LANELIGHT_INTERSECT_SLABS_INL_H_

#include <limits>

#include "kernels/intersect/rays-inl.h"
#include "src/scene/geometry/accel.h"

LANELIGHT_BEGIN_KERNELS

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
    const VF least = Splat(0x1p-80f);
    octant = hn::Zero(di);
    for (int a = 0; a < 3; ++a) {
      const MF tiny = hn::Lt(hn::Abs(d[a]), least);
      const VF da = hn::IfThenElse(tiny, hn::CopySign(least, d[a]), d[a]);
      const VF r = hn::Div(Splat(1.0f), da);
      const VF c = hn::Neg(hn::Mul(o[a], r)), grow = hn::Mul(delta, hn::Abs(r));
      rcp[a] = r;
      near[a] = hn::Sub(c, grow);
      far[a] = hn::Add(c, grow);
      negative[a] = hn::Lt(da, hn::Zero(df));
      octant = hn::Or(octant, OfNegative(a, 1 << a));
    }
  }

  /// `value` in the lanes whose direction is negative along axis a, else 0.
  LANELIGHT_INLINE VI OfNegative(int a, int32_t value) const {
    const DI di;
    return hn::IfThenElseZero(hn::RebindMask(di, negative[a]), hn::Set(di, value));
  }

  /// The lanes that are rays. One that is not (NaN, infinite) must enter nothing: what
  /// Min and Max make of NaN differs between targets, and unused children must not be
  /// entered.
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
