// The footprint of a pixel at surface hits, in surface coordinates (src/scene/compiled/
// view.h). The step from one pixel to the next, at the distance of the hit, is
// carried along the line of sight into the tangent plane; least squares give the steps in
// u and v (as in pbrt-v4, SurfaceInteraction::ComputeDifferentials).
#include "kernels/simd/each_target-inl.h"

#include "kernels/surface/pixel_steps-inl.h"

LANELIGHT_BEGIN_KERNELS

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

// Writes what a step in the plane of the surface is in u, v.
HWY_INLINE void StoreStep(const UvAxes& axes, V3 step, float* du, float* dv,
                          const StoreSlots& slots) {
  const VF u = Dot(axes.u, step), v = Dot(axes.v, step);
  const VF along_u = hn::Mul(hn::NegMulAdd(axes.cosine, v, u), axes.inverse);
  const VF along_v = hn::Mul(hn::NegMulAdd(axes.cosine, u, v), axes.inverse);
  Scatter(Bounded(hn::Div(along_u, axes.length_u)), du, slots);
  Scatter(Bounded(hn::Div(along_v, axes.length_v)), dv, slots);
}

void Footprints(Wave& wave) {
  const PathColumns& path = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kSurface), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
        const UvAxes axes(Gather3(path.tg_x, path.tg_y, path.tg_z, slots),
                          Gather3(path.tv_x, path.tv_y, path.tv_z, slots));
        const PixelSteps steps =
            StepsOfPaths(wave, slots, Gather3(path.p_x, path.p_y, path.p_z, slots));
        // Steps move along the sight into the plane across n.
        const V3 x = InPlane(n, steps.sight, steps.x),
                 y = InPlane(n, steps.sight, steps.y);
        StoreStep(axes, x, path.footprint_0, path.footprint_2, slots);
        StoreStep(axes, y, path.footprint_1, path.footprint_3, slots);
      });
}

Stage FootprintsStage() {
  return {.name = "footprints",
          .meaning = "computes the pixel footprint in surface coordinates",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kTextureFootprints, Feature::kScatters},
          .reads = fields::kPoint | fields::kNormal | fields::kTangents |
                   FieldSet{Field::time},
          .writes = fields::kFootprint,
          .resolve = Always<Footprints>};
}

LANELIGHT_END_KERNELS
