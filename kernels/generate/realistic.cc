// Rays through a system of lenses: from a point of the film to one of the exit pupil,
// then refracted at each surface. Rays that the lenses stop end at once.
//   weight      cos^4 A / z^2, A the area that pupil points are chosen in, z its distance
//               from the film: radiance to irradiance at the film
//   surfaces    in coordinates about the point p where they meet the axis, of curvature
//   k:
//               k t^2 + 2 (k p.d - d_z) t + k |p|^2 - 2 p_z = 0 for unit d. The root near
//               p, in the form that has no cancellation, however flat the surface is
//   source      Kolb, Mitchell and Hanrahan 1995; pbrt-v4
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"
#include "kernels/generate/lenses-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kBox>
HWY_INLINE void LensBatch(Wave& wave, const StoreSlots& slots, MF valid) {
  const CompiledCamera& camera = *wave.camera;
  const PathColumns& p = wave.path;
  const auto splat = [](Vec3f v) HWY_ATTR { return Splat3(v.x, v.y, v.z); };
  StoreFirstValues(wave, slots);
  VF x, y;
  FilmPosition<kBox>(wave, slots, &x, &y);
  const V3 film =
      MulAdd(splat(camera.dx), x, MulAdd(splat(camera.dy), y, splat(camera.base)));
  LensRay ray = LeaveFilm(camera.lenses, film, Gather(p.u_lens_0, slots),
                          Gather(p.u_lens_1, slots));
  TraceLenses(camera.lenses, ray);
  const ShadingFrame axes = {splat(camera.right), splat(camera.up),
                             splat(camera.forward)};
  const V3 local = Mul(ray.o, Splat(camera.lenses.scene_from_mm));
  Scatter3(splat(camera.origin) + axes.FromLocal(local), p.o_x, p.o_y, p.o_z, slots);
  Scatter3(Normalize(axes.FromLocal(ray.d)), p.d_x, p.d_y, p.d_z, slots);
  VF weight = ray.weight;
  // The filter has left its own there.
  if constexpr (!kBox) weight = hn::Mul(weight, Gather(p.weight, slots));
  Scatter(weight, p.weight, slots);
  const MF passes = hn::Gt(ray.weight, Splat(0));
  Push(wave.queue(QueueId::kActive), slots, hn::And(passes, valid));
  Push(wave.queue(QueueId::kDone), slots, hn::AndNot(passes, valid));
}

template <bool kBox>
void Realistic(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kCamera),
               [&](const StoreSlots& slots, MF valid)
                   HWY_ATTR { LensBatch<kBox>(wave, slots, valid); });
}

Stage RealisticCameraStage() {
  return MakeCameraStage(
      "camera_realistic", "rays through lenses, and the first values of a path",
      Feature::kRealisticCamera,
      ByFeature<Feature::kFiltered, Realistic<false>, Realistic<true>>);
}

LANELIGHT_END_KERNELS
