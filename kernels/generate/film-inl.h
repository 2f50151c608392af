// Chooses the film position of a sample.
#ifndef LANELIGHT_GENERATE_FILM_INL_H_
#define LANELIGHT_GENERATE_FILM_INL_H_

#include "kernels/generate/filter-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/pixel-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

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
