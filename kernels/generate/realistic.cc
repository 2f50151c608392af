// Rays through a system of lenses: from a point of the film to one of the exit pupil,
// then refracted at each surface. Rays that the lenses stop end at once.
//   weight      cos^4 A / z^2, A the area that pupil points are chosen in, z its distance
//               from the film: radiance to irradiance at the film
//   surfaces    in coordinates about the point p where they meet the axis, with
//               curvature k:
//               k t^2 + 2 (k p.d - d_z) t + k |p|^2 - 2 p_z = 0 for unit d. The root near
//               p, in the form that has no cancellation, however flat the surface is
//   source      Kolb, Mitchell and Hanrahan 1995; pbrt-v4
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"
#include "kernels/simd/records-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

// Rays through lenses are in millimetres from the middle of the film, z towards the scene
// (src/scene/compiled/camera.h, LensSystem).

// `d` is a unit vector; `weight` is 0 from where the ray is stopped.
struct LensRay {
  V3 o, d;
  VF weight;
};

// Starts a ray at a point of the film, towards a point of the exit pupil's bounds.
HWY_INLINE LensRay RayFromFilm(const LensSystem& lenses, V3 film, VF u0, VF u1) {
  const DI di;
  const VF r = hn::Sqrt(hn::MulAdd(film.x, film.x, hn::Mul(film.y, film.y)));
  const VI last = hn::Set(di, static_cast<int32_t>(lenses.pupils.size()) - 1);
  const VI ring =
      hn::Min(hn::ConvertTo(di, hn::Mul(r, Splat(lenses.rings_per_mm))), last);
  using Pupil = LensSystem::Pupil;
  const RecordWords bounds(lenses.pupils.data(), ring);
  const VF x0 = bounds.F(offsetof(Pupil, x0)), x1 = bounds.F(offsetof(Pupil, x1));
  const VF y0 = bounds.F(offsetof(Pupil, y0)), y1 = bounds.F(offsetof(Pupil, y1));
  const VF x = hn::MulAdd(u0, hn::Sub(x1, x0), x0);
  const VF y = hn::MulAdd(u1, hn::Sub(y1, y0), y0);
  // The bounds are turned about the axis as the film point is.
  const MF off_axis = hn::Gt(r, Splat(0));
  const VF cosine = hn::IfThenElse(off_axis, hn::Div(film.x, r), Splat(1.0f));
  const VF sine = hn::IfThenElseZero(off_axis, hn::Div(film.y, r));
  const V3 pupil = {hn::NegMulAdd(sine, y, hn::Mul(cosine, x)),
                    hn::MulAdd(sine, x, hn::Mul(cosine, y)), Splat(lenses.rear)};
  const V3 d = Normalize(pupil - film);
  const VF area = hn::Mul(hn::Max(hn::Sub(x1, x0), Splat(0)), hn::Sub(y1, y0));
  const VF cos2 = hn::Mul(d.z, d.z);
  const VF per_area = Splat(1.0f / (lenses.rear * lenses.rear));
  return {film, d, hn::Mul(hn::Mul(cos2, cos2), hn::Mul(area, per_area))};
}

// Returns the bilinear transmittance of the aperture image, which is black outside; (x,
// y) are in units of the stop's radius.
HWY_INLINE VF ApertureFraction(const LensSystem& lenses, VF x, VF y) {
  const DI di;
  const VF n = Splat(static_cast<float>(lenses.aperture_size)), half = Splat(0.5f);
  const auto texels = [&](VF v) HWY_ATTR {
    const VF inside = hn::Min(hn::Max(v, Splat(-2.0f)), Splat(2.0f));
    return hn::Sub(hn::Mul(hn::MulAdd(inside, half, half), n), half);
  };
  const VF s = texels(x), t = texels(y);
  const VF i = hn::Floor(s), j = hn::Floor(t);
  const VF right = hn::Sub(s, i), below = hn::Sub(t, j);
  const auto texel = [&](float dx, float dy) HWY_ATTR {
    const VF column = hn::Add(i, Splat(dx)), row = hn::Add(j, Splat(dy));
    const VF zero = Splat(0);
    const MF in = hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, n)),
                          hn::And(hn::Ge(row, zero), hn::Lt(row, n)));
    const VI at = hn::Add(hn::Mul(hn::ConvertTo(di, hn::IfThenElseZero(in, row)),
                                  hn::Set(di, lenses.aperture_size)),
                          hn::ConvertTo(di, hn::IfThenElseZero(in, column)));
    return hn::IfThenElseZero(in, Gather(lenses.aperture.data(), at));
  };
  const VF one = Splat(1.0f), left = hn::Sub(one, right);
  const VF top = hn::MulAdd(texel(1, 0), right, hn::Mul(texel(0, 0), left));
  const VF bottom = hn::MulAdd(texel(1, 1), right, hn::Mul(texel(0, 1), left));
  return hn::MulAdd(bottom, below, hn::Mul(top, hn::Sub(one, below)));
}

HWY_INLINE MF InAperture(const LensSurface& surface, V3 p) {
  const VF r2 = hn::MulAdd(p.x, p.x, hn::Mul(p.y, p.y));
  return hn::Le(r2, Splat(surface.aperture * surface.aperture));
}

HWY_INLINE void PassStop(const LensSystem& lenses, const LensSurface& stop,
                         LensRay& ray) {
  const VF t = hn::Div(hn::Sub(Splat(stop.z), ray.o.z), ray.d.z);
  ray.o = MulAdd(ray.d, t, ray.o);
  if (lenses.aperture_size > 0) {
    const VF scale = Splat(1 / stop.aperture);
    ray.weight = hn::Mul(ray.weight, ApertureFraction(lenses, hn::Mul(ray.o.x, scale),
                                                      hn::Mul(ray.o.y, scale)));
  } else {
    ray.weight = hn::IfThenElseZero(InAperture(stop, ray.o), ray.weight);
  }
  ray.weight = hn::IfThenElseZero(hn::Ge(t, Splat(0)), ray.weight);
}

HWY_INLINE void PassSurface(const LensSurface& surface, LensRay& ray) {
  const VF k = Splat(1 / surface.radius), zero = Splat(0), one = Splat(1.0f);
  const V3 p = {ray.o.x, ray.o.y, hn::Sub(ray.o.z, Splat(surface.z))};
  const VF b = hn::MulSub(k, Dot(p, ray.d), ray.d.z);
  const VF c = hn::MulSub(k, Dot(p, p), hn::Add(p.z, p.z));
  const VF discriminant = hn::NegMulAdd(k, c, hn::Mul(b, b));
  // This is also the cosine of the angle to the normal.
  const VF root = hn::Sqrt(hn::Max(discriminant, zero));
  const VF t = hn::Div(c, hn::Sub(root, b));
  const V3 q = MulAdd(ray.d, t, p);
  const V3 n = Normalize({hn::Mul(k, q.x), hn::Mul(k, q.y), hn::MulSub(k, q.z, one)});
  const VF eta = Splat(surface.eta_ratio);
  const VF cos_i = hn::Neg(Dot(ray.d, n));
  const VF sin2_t = hn::Mul(hn::Mul(eta, eta), hn::NegMulAdd(cos_i, cos_i, one));
  const VF cos_t = hn::Sqrt(hn::Max(hn::Sub(one, sin2_t), zero));
  const MF passes = hn::And(hn::And(hn::Ge(discriminant, zero), hn::Ge(t, zero)),
                            hn::And(hn::Lt(sin2_t, one), InAperture(surface, q)));
  ray.o = {q.x, q.y, hn::Add(q.z, Splat(surface.z))};
  ray.d = Normalize(MulAdd(n, hn::MulSub(eta, cos_i, cos_t), Mul(ray.d, eta)));
  ray.weight = hn::IfThenElseZero(passes, ray.weight);
}

// Traces a ray through all surfaces; a ray that is stopped stays finite.
HWY_INLINE void TraceLenses(const LensSystem& lenses, LensRay& ray) {
  for (const LensSurface& surface : lenses.surfaces) {
    if (surface.radius == 0) {
      PassStop(lenses, surface, ray);
    } else {
      PassSurface(surface, ray);
    }
    const MF alive = hn::Gt(ray.weight, Splat(0));
    ray.o = IfThenElse(alive, ray.o, Splat3(0, 0, 0));
    ray.d = IfThenElse(alive, ray.d, Splat3(0, 0, 1));
  }
}

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
  LensRay ray = RayFromFilm(camera.lenses, film, Gather(p.u_lens_0, slots),
                            Gather(p.u_lens_1, slots));
  TraceLenses(camera.lenses, ray);
  const ShadingFrame axes = {splat(camera.right), splat(camera.up),
                             splat(camera.forward)};
  const V3 local = Mul(ray.o, Splat(camera.lenses.scene_from_mm));
  Scatter3(splat(camera.origin) + axes.FromLocal(local), p.o_x, p.o_y, p.o_z, slots);
  Scatter3(Normalize(axes.FromLocal(ray.d)), p.d_x, p.d_y, p.d_z, slots);
  VF weight = ray.weight;
  // The column already holds the weight of the filter.
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
