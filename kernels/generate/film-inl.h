// Chooses the film position of a sample.
#ifndef LANELIGHT_GENERATE_FILM_INL_H_
#define LANELIGHT_GENERATE_FILM_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/pixel-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

/// Returns an offset in [-radius, radius) distributed like the piecewise-constant |f|,
/// and the sign of f there. Monotone in u, so it keeps the stratification of the sample
/// points.
HWY_INLINE VF SampleFilterAxis(const float* cdf, const float* signs, float radius, VF u,
                               VF* sign) {
  const DI di;
  VI bin = hn::Zero(di);
  for (int step = CompiledFilter::kSize / 2; step > 0; step /= 2) {
    const VI next = hn::Add(bin, hn::Set(di, step));
    const auto right = hn::RebindMask(di, hn::Le(Gather(cdf, next), u));
    bin = hn::IfThenElse(right, next, bin);
  }
  const VF low = Gather(cdf, bin), high = Gather(cdf + 1, bin);
  const VF width = hn::Sub(high, low);
  const VF inside = hn::IfThenElse(hn::Gt(width, Splat(0)),
                                   hn::Div(hn::Sub(u, low), width), Splat(0.5f));
  *sign = Gather(signs, bin);
  const VF position = hn::Add(hn::ConvertTo(DF(), bin), inside);
  const float bin_width = 2 * radius / CompiledFilter::kSize;
  return hn::MulAdd(position, Splat(bin_width), Splat(-radius));
}

/// Film position in pixels: pixel centre plus a point distributed like |filter|.
template <bool kBox>
HWY_INLINE void FilmPosition(const Wave& wave, const StoreSlots& slots, VF* x, VF* y) {
  const CompiledFilter& filter = *wave.filter;
  const PathColumns& p = wave.path;
  const VI pixel = Gather(p.pixel, slots);
  const VF u0 = Gather(p.u_film_0, slots), u1 = Gather(p.u_film_1, slots);
  VF dx, dy;
  if constexpr (kBox) {
    dx = hn::Mul(hn::MulAdd(u0, Splat(2.0f), Splat(-1.0f)), Splat(filter.x_radius));
    dy = hn::Mul(hn::MulAdd(u1, Splat(2.0f), Splat(-1.0f)), Splat(filter.y_radius));
  } else {
    VF sign_x, sign_y;
    dx = SampleFilterAxis(filter.x_cdf.data(), filter.x_sign.data(), filter.x_radius, u0,
                          &sign_x);
    dy = SampleFilterAxis(filter.y_cdf.data(), filter.y_sign.data(), filter.y_radius, u1,
                          &sign_y);
    if (p.weight != nullptr) {
      Scatter(hn::Mul(hn::Mul(sign_x, sign_y), Splat(filter.weight)), p.weight, slots);
    }
  }
  const PixelPlace place(pixel, wave.run->width);
  *x = hn::Add(hn::Add(hn::ConvertTo(DF(), place.column), Splat(0.5f)), dx);
  *y = hn::Add(hn::Add(hn::ConvertTo(DF(), place.row), Splat(0.5f)), dy);
}

/// A camera, present where the plan has `projection`.
inline Stage MakeCameraStage(const char* name, const char* meaning, Feature projection,
                             StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kCamera,
          .role = StageRole::kCamera,
          .needs = {projection},
          .reads = {Field::pixel, Field::u_film_0, Field::u_film_1, Field::u_lens_0,
                    Field::u_lens_1},
          .writes = fields::kRay | fields::WithFirstValue() |
                    FieldSet{Field::weight, Field::medium},
          .resolve = resolve};
}

LANELIGHT_END_KERNELS

#endif
