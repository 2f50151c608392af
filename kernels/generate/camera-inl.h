// The skeleton of every camera: film position, projection, thin lens, and first values of
// a path. A projection is a struct with static CameraRay Project(V3 film). It returns the
// ray through a point of CompiledCamera's film in camera space; its direction reaches
// depth 1 at its end, so the plane of focus is a plane of constant depth.
#ifndef LANELIGHT_GENERATE_CAMERA_INL_H_
#define LANELIGHT_GENERATE_CAMERA_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "kernels/warp/sphere-inl.h"
#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/media.h"

LANELIGHT_BEGIN_KERNELS

/// A place in the pixel filter along an axis, in bins, and the bin.
struct FilterPlace {
  VF at;
  VI bin;
};

/// Returns a place distributed like the piecewise-constant |f|. Monotone in u, so it
/// keeps the stratification of the sample points.
HWY_INLINE FilterPlace SampleFilterAxis(const float* cdf, VF u) {
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
  return {hn::Add(hn::ConvertTo(DF(), bin), inside), bin};
}

/// Returns the offset from the centre of the pixel, in [-radius, radius).
HWY_INLINE VF OffsetOf(const FilterPlace& place, float radius) {
  const float bin_width = 2 * radius / CompiledFilter::kSize;
  return hn::MulAdd(place.at, Splat(bin_width), Splat(-radius));
}

/// Returns the film position in pixels: pixel centre plus a point distributed like
/// |filter|.
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
    const FilterPlace along_x = SampleFilterAxis(filter.x_cdf.data(), u0);
    const FilterPlace along_y = SampleFilterAxis(filter.y_cdf.data(), u1);
    dx = OffsetOf(along_x, filter.x_radius);
    dy = OffsetOf(along_y, filter.y_radius);
    if (p.weight != nullptr) {
      const VF sign = hn::Mul(Gather(filter.x_sign.data(), along_x.bin),
                              Gather(filter.y_sign.data(), along_y.bin));
      Scatter(hn::Mul(sign, Splat(filter.weight)), p.weight, slots);
    }
  }
  const PixelPlace place(pixel, wave.run->width);
  *x = hn::Add(hn::Add(hn::ConvertTo(DF(), place.column), Splat(0.5f)), dx);
  *y = hn::Add(hn::Add(hn::ConvertTo(DF(), place.row), Splat(0.5f)), dy);
}

/// Returns a camera's stage, for plans with the feature `projection`.
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

/// In camera space; `direction` has the depth 1 and is not normalised.
struct CameraRay {
  V3 origin, direction;
};

/// Returns the ray from a point of a thin lens at `ray.origin` that meets `ray` in focus
/// (Kolb, Mitchell and Hanrahan 1995, the thin lens).
HWY_INLINE CameraRay ThroughLens(const CompiledCamera& camera, CameraRay ray, VF u0,
                                 VF u1) {
  const V2 lens = SampleDisk(u0, u1);
  const VF radius = Splat(camera.lens_radius);
  const V3 focus = MulAdd(ray.direction, Splat(camera.focal_distance), ray.origin);
  const V3 origin =
      ray.origin + V3{hn::Mul(lens.x, radius), hn::Mul(lens.y, radius), Splat(0)};
  return {origin, focus - origin};
}

/// Stores the first values of fields.h, and the medium of the camera.
HWY_INLINE void StoreFirstValues(const Wave& wave, const StoreSlots& slots) {
  const ColumnLists& lists = wave.lists;
  for (uint32_t i = 0; i < lists.begun.count; ++i) {
    const VU bits = hn::Set(DU(), lists.first_values[i]);
    Scatter(hn::BitCast(DI(), bits), lists.begun.columns[i], slots);
  }
  if (wave.path.medium != nullptr) {
    Scatter(hn::Set(DI(), wave.media->camera), wave.path.medium, slots);
  }
}

template <class Projection, bool kBox, bool kLens>
void Camera(Wave& wave) {
  const CompiledCamera& camera = *wave.camera;
  const PathColumns& p = wave.path;
  const auto splat = [](Vec3f v) HWY_ATTR { return Splat3(v.x, v.y, v.z); };
  const V3 base = splat(camera.base), dx = splat(camera.dx), dy = splat(camera.dy);
  const ShadingFrame axes = {splat(camera.right), splat(camera.up),
                             splat(camera.forward)};
  ForEachBatch(wave, wave.queue(QueueId::kCamera),
               [&](const StoreSlots& slots, MF valid) HWY_ATTR {
                 StoreFirstValues(wave, slots);
                 VF x, y;
                 FilmPosition<kBox>(wave, slots, &x, &y);
                 CameraRay ray = Projection::Project(MulAdd(dx, x, MulAdd(dy, y, base)));
                 if constexpr (kLens) {
                   ray = ThroughLens(camera, ray, Gather(p.u_lens_0, slots),
                                     Gather(p.u_lens_1, slots));
                 }
                 const V3 o = splat(camera.origin) + axes.FromLocal(ray.origin);
                 Scatter3(o, p.o_x, p.o_y, p.o_z, slots);
                 Scatter3(Normalize(axes.FromLocal(ray.direction)), p.d_x, p.d_y, p.d_z,
                          slots);
                 Push(wave.queue(QueueId::kActive), slots, valid);
               });
}

/// Returns the kernel of this target for the features of a scene.
template <class Projection>
StageFn ResolveCamera(const FeatureSet& features) {
  if (features.Has(Feature::kLens)) {
    return features.Has(Feature::kFiltered) ? Camera<Projection, false, true>
                                            : Camera<Projection, true, true>;
  }
  return features.Has(Feature::kFiltered) ? Camera<Projection, false, false>
                                          : Camera<Projection, true, false>;
}

LANELIGHT_END_KERNELS

#endif
