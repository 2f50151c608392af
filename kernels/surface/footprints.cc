// The footprint of a pixel at surface hits, in surface coordinates (src/compiled/
// footprint.h). The step from one pixel to the next, at the distance of the hit, is
// carried along the line of sight into the tangent plane; least squares give the steps in
// u and v (as in pbrt-v4, SurfaceInteraction::ComputeDifferentials).
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/surface/footprints.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE V3 SplatVec(Vec3f v) { return Splat3(v.x, v.y, v.z); }

// The line of sight, unit, and what lies one pixel beside the hit, at its distance.
struct PixelSteps {
  V3 sight, x, y;
};

// `axis`, which is across the camera's forward direction, turned with it to the line of
// sight, or with the backward direction if that is nearer.
HWY_INLINE V3 Turned(V3 axis, V3 forward, V3 sight) {
  const VF cosine = Dot(forward, sight);
  const V3 sum = Mul(forward, hn::CopySign(Splat(1.0f), cosine)) + sight;
  const VF share = hn::Div(Dot(axis, sight), hn::Add(Splat(1.0f), hn::Abs(cosine)));
  return MulAdd(sum, hn::Neg(share), axis);
}

HWY_INLINE PixelSteps StepsAt(const PixelFootprint& f, V3 p) {
  const V3 forward = SplatVec(f.forward);
  if (f.parallel) return {forward, SplatVec(f.step_x), SplatVec(f.step_y)};
  const V3 from_eye = p - SplatVec(f.eye);
  const VF distance = hn::Sqrt(Dot(from_eye, from_eye)), depth = Dot(from_eye, forward);
  const V3 sight = Mul(from_eye, hn::Div(Splat(1.0f), distance));
  const MF in_front = hn::Ge(depth, hn::Mul(Splat(f.min_cosine), distance));
  const auto step = [&](Vec3f pixel, Vec3f axis, float angle) HWY_ATTR {
    const V3 turned = Turned(SplatVec(axis), forward, sight);
    return IfThenElse(in_front, Mul(SplatVec(pixel), depth),
                      Mul(turned, hn::Mul(distance, Splat(angle))));
  };
  return {sight, step(f.step_x, f.axis_x, f.angle_x),
          step(f.step_y, f.axis_y, f.angle_y)};
}

// dp/du and dp/dv as unit vectors with lengths: their squares may underflow.
struct UvAxes {
  V3 u, v;
  VF length_u, length_v;
  VF cosine, inverse;  // of the angle between them, 1 / its squared sine

  HWY_INLINE UvAxes(V3 tg, V3 tv)
      : length_u(hn::Sqrt(Dot(tg, tg))), length_v(hn::Sqrt(Dot(tv, tv))) {
    u = Mul(tg, hn::Div(Splat(1.0f), length_u));
    v = Mul(tv, hn::Div(Splat(1.0f), length_v));
    cosine = Dot(u, v);
    inverse = hn::Div(Splat(1.0f), hn::NegMulAdd(cosine, cosine, Splat(1.0f)));
  }
};

// Zero if it is not a number, as where u and v have one direction.
HWY_INLINE VF Bounded(VF step) {
  const VF limit = Splat(1e8f);
  const VF finite = hn::IfThenElseZero(hn::Eq(step, step), step);
  return hn::Max(hn::Neg(limit), hn::Min(finite, limit));
}

// Moves the step along the sight into the plane across n and writes what it is in u, v.
HWY_INLINE void StoreStep(const UvAxes& axes, V3 n, V3 sight, V3 step, float* du,
                          float* dv, const StoreSlots& slots) {
  const VF lift = hn::Div(Dot(n, step), Dot(n, sight));
  const V3 in_plane = MulAdd(sight, hn::Neg(lift), step);
  const VF u = Dot(axes.u, in_plane), v = Dot(axes.v, in_plane);
  const VF along_u = hn::Mul(hn::NegMulAdd(axes.cosine, v, u), axes.inverse);
  const VF along_v = hn::Mul(hn::NegMulAdd(axes.cosine, u, v), axes.inverse);
  Scatter(Bounded(hn::Div(along_u, axes.length_u)), du, slots);
  Scatter(Bounded(hn::Div(along_v, axes.length_v)), dv, slots);
}

void Footprints(Wave& wave) {
  const PathColumns& path = wave.path;
  const PixelFootprint& footprint = wave.scene->footprint;
  ForEachBatch(
      wave, wave.queue(QueueId::kSurface), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
        const UvAxes axes(Gather3(path.tg_x, path.tg_y, path.tg_z, slots),
                          Gather3(path.tv_x, path.tv_y, path.tv_z, slots));
        const PixelSteps steps =
            StepsAt(footprint, Gather3(path.p_x, path.p_y, path.p_z, slots));
        StoreStep(axes, n, steps.sight, steps.x, path.spread_0, path.spread_2, slots);
        StoreStep(axes, n, steps.sight, steps.y, path.spread_1, path.spread_3, slots);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/surface/stages.h"

namespace lanelight {
HWY_EXPORT(Footprints);

Stage FootprintsStage() {
  return {"footprints",
          "footprint of a pixel in surface coordinates",
          QueueId::kSurface,
          {Feature::kTextureFootprints, Feature::kScatters},
          fields::kPoint | fields::kNormal | fields::kTangents,
          fields::kSpread,
          [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(Footprints); }};
}

}  // namespace lanelight
#endif
