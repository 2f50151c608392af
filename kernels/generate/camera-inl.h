// The skeleton of every camera: film position, projection, thin lens, and first values of
// a path. A projection is a struct with static CameraRay Project(V3 film). It returns the
// ray through a point of CompiledCamera's film in camera space; its direction reaches
// depth 1 at its end, so the plane of focus is a plane of constant depth.
#ifndef LANELIGHT_GENERATE_CAMERA_INL_H_
#define LANELIGHT_GENERATE_CAMERA_INL_H_

#include "kernels/generate/film-inl.h"
#include "kernels/warp/disk-inl.h"
#include "src/scene/compiled/media.h"

LANELIGHT_BEGIN_KERNELS

/// In camera space; `direction` has the depth 1 and is not normalised.
struct CameraRay {
  V3 origin, direction;
};

/// The ray from a point of a thin lens at `ray.origin` that meets `ray` in focus (Kolb,
/// Mitchell and Hanrahan 1995, the thin lens).
HWY_INLINE CameraRay ThroughLens(const CompiledCamera& camera, CameraRay ray, VF u0,
                                 VF u1) {
  const V2 lens = SampleDisk(u0, u1);
  const VF radius = Splat(camera.lens_radius);
  const V3 focus = MulAdd(ray.direction, Splat(camera.focal_distance), ray.origin);
  const V3 origin =
      ray.origin + V3{hn::Mul(lens.x, radius), hn::Mul(lens.y, radius), Splat(0)};
  return {origin, focus - origin};
}

/// What fields.h says that a path begins with, and the medium of the camera.
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

/// The kernel of this target for the features of a scene.
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
