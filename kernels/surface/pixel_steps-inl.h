// Finds the points one pixel beside a point (src/scene/compiled/camera.h), in the
// camera's view and in the tangent plane.
#ifndef LANELIGHT_SURFACE_PIXEL_STEPS_INL_H_
#define LANELIGHT_SURFACE_PIXEL_STEPS_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/motion-inl.h"
#include "src/scene/compiled/camera.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE V3 SplatVec(Vec3f v) { return Splat3(v.x, v.y, v.z); }

// The line of sight, unit, and the steps to one pixel beside the hit, at its distance.
struct PixelSteps {
  V3 sight, x, y;
};

// Turns `axis`, which is across the camera's forward direction, with that direction, or
// with the backward one if it is nearer, to the line of sight.
HWY_INLINE V3 RotatedToSight(V3 axis, V3 forward, V3 sight) {
  const VF cosine = Dot(forward, sight);
  const V3 sum = Mul(forward, hn::CopySign(Splat(1.0f), cosine)) + sight;
  const VF fraction = hn::Div(Dot(axis, sight), hn::Add(Splat(1.0f), hn::Abs(cosine)));
  return MulAdd(sum, hn::Neg(fraction), axis);
}

HWY_INLINE PixelSteps StepsAt(const PixelFootprint& f, V3 p) {
  const V3 forward = SplatVec(f.forward);
  if (f.parallel) return {forward, SplatVec(f.step_x), SplatVec(f.step_y)};
  const V3 from_eye = p - SplatVec(f.eye);
  const VF distance = hn::Sqrt(Dot(from_eye, from_eye)), depth = Dot(from_eye, forward);
  const V3 sight = Mul(from_eye, hn::Div(Splat(1.0f), distance));
  const MF in_front = hn::Ge(depth, hn::Mul(Splat(f.min_cosine), distance));
  const auto step = [&](Vec3f pixel, Vec3f axis, float angle) HWY_ATTR {
    const V3 turned = RotatedToSight(SplatVec(axis), forward, sight);
    return IfThenElse(in_front, Mul(SplatVec(pixel), depth),
                      Mul(turned, hn::Mul(distance, Splat(angle))));
  };
  return {sight, step(f.step_x, f.axis_x, f.angle_x),
          step(f.step_y, f.axis_y, f.angle_y)};
}

// The same at the times of paths, where the camera moves.
HWY_NOINLINE inline PixelSteps MovedSteps(const SceneParts& view, V3 p, VF time) {
  const MovedSpace space = SpaceAt(OneMotion{view.camera->motion}, time);
  const PixelSteps steps = StepsAt(*view.footprint, space.Back().Point(p));
  const Map34 map = space.Forward();
  return {map.Vector(steps.sight), map.Vector(steps.x), map.Vector(steps.y)};
}

HWY_INLINE PixelSteps StepsOfPaths(const Wave& wave, const Slots& slots, V3 p) {
  const SceneParts& view = wave;
  if (HWY_UNLIKELY(view.camera->moves)) {
    return MovedSteps(view, p, Gather(wave.path.time, slots));
  }
  return StepsAt(*view.footprint, p);
}

// A step moved along the sight into the plane across n.
HWY_INLINE V3 InPlane(V3 n, V3 sight, V3 step) {
  return MulAdd(sight, hn::Neg(hn::Div(Dot(n, step), Dot(n, sight))), step);
}

// Zero if it is not a number, as where u and v have one direction.
HWY_INLINE VF Bounded(VF step) {
  const VF limit = Splat(1e8f);
  const VF finite = hn::IfThenElseZero(hn::Eq(step, step), step);
  return hn::Max(hn::Neg(limit), hn::Min(finite, limit));
}

LANELIGHT_END_KERNELS

#endif
