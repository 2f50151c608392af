// Light samples on emitting spheres and disks. Spheres: uniform over the cone of
// directions that the sphere fills; from inside, and where its far side is seen through
// holes, uniform over its area.
//   density     outside pdf_sa = pmf / (2 pi (1 - cos_max)); inside pdf_area = pmf / area
//   source      Shirley, Wang and Zimmerman 1996, "Monte Carlo Techniques for Direct
//               Lighting Calculations"; 1 - cos_max in a form exact for tiny spheres
// Disks and rings: uniform over the area, pdf_area = pmf / area.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"
#include "src/scene/compiled/lights.h"
#include "src/vocabulary/path/scene_parts.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// Distance along unit direction w (from outside) to the near side of the sphere at
// relative centre c: with the closest approach h = c - (c.w) w, t = c.w - sqrt(r^2 -
// h^2). Rounded down: h^2 is off by up to about 8 ulp of r |c|, which near the
// silhouette, where the root is steep, would put t behind the sphere's own surface.
HWY_INLINE VF NearDistance(V3 c, V3 w, VF radius) {
  const VF along = Dot(c, w);
  const V3 h = c - Mul(w, along);
  const VF half2 = hn::Sub(hn::Mul(radius, radius), Dot(h, h));
  const VF rounding = hn::Mul(hn::Mul(Splat(1e-6f), radius), hn::Sqrt(Dot(c, c)));
  return hn::Sub(along, hn::Sqrt(hn::Add(hn::Max(half2, Splat(0)), rounding)));
}

// The data of a batch's lights that a sample needs.
struct SphereEmitters {
  LightSphere sphere;
  V3 radiance;
  VF pmf, area, cone_from;
  VI two_sided;

  HWY_INLINE SphereEmitters(const SceneParts& scene, const Lights& light, VI prim,
                            VF selected)
      : sphere(scene, prim),
        radiance(light.Radiance()),
        pmf(selected),
        area(light.Area()),
        cone_from(light.ConeFrom()),
        two_sided(light.I(offsetof(LightRecord, two_sided))) {}

  /// One for each of the scene's lights, which fit into a vector.
  HWY_INLINE static SphereEmitters All(const Wave& wave) {
    const DI di;
    const SceneParts& scene = wave;
    const auto last = static_cast<int32_t>(scene.lights->lights.size()) - 1;
    const VI index = hn::Min(hn::Iota(di, 0), hn::Set(di, last));
    const VI first = hn::Set(di, static_cast<int32_t>(scene.ranges->spheres));
    const Lights light(scene, index);
    const auto shape = hn::Eq(light.I(offsetof(LightRecord, shape)),
                              hn::Set(di, static_cast<int32_t>(LightShape::kSphere)));
    return {scene, light, hn::IfThenElse(shape, light.Primitive(), first),
            Gather(wave.chances->pmf.data(), index)};
  }

  HWY_INLINE SphereEmitters Choose(VI light) const {
    const auto at = hn::IndicesFromVec(DF(), light);
    const auto pick = [&](VF v) HWY_ATTR { return hn::TableLookupLanes(v, at); };
    const auto pick3 = [&](V3 v) HWY_ATTR { return V3{pick(v.x), pick(v.y), pick(v.z)}; };
    SphereEmitters chosen = *this;
    chosen.sphere.center = pick3(sphere.center);
    chosen.sphere.radius = pick(sphere.radius);
    chosen.sphere.normal_sign = pick(sphere.normal_sign);
    chosen.radiance = pick3(radiance);
    chosen.pmf = pick(pmf);
    chosen.area = pick(area);
    chosen.cone_from = pick(cone_from);
    chosen.two_sided = hn::BitCast(DI(), pick(hn::BitCast(DF(), two_sided)));
    return chosen;
  }
};

HWY_INLINE void SampleEmitters(const PathColumns& p, const StoreSlots& slots,
                               const SphereEmitters& light) {
  const LightSphere& sphere = light.sphere;
  const float two_pi = 6.28318530717958648f;
  const MF two_sided = hn::RebindMask(DF(), hn::Ne(light.two_sided, hn::Zero(DI())));
  const V3 from = Gather3(p.p_x, p.p_y, p.p_z, slots);
  const VF u0 = Gather(p.u_light_0, slots), u1 = Gather(p.u_light_1, slots);
  const V3 to_center = sphere.center - from;
  const VF d2 = Dot(to_center, to_center);
  const MF outside = hn::Gt(d2, light.cone_from);
  const auto [sine, cosine] = SinCos2Pi(u1);

  // Inside: area sampling. Computed for all lanes; the other side overwrites below.
  const VF z = hn::NegMulAdd(Splat(2.0f), u0, Splat(1.0f));
  const VF ring = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, Splat(1.0f)), Splat(0)));
  const V3 n = {hn::Mul(ring, cosine), hn::Mul(ring, sine), z};
  const V3 normal = Mul(n, sphere.normal_sign);
  if (!hn::AllTrue(DF(), outside)) {
    StoreSurfaceSample(
        p, slots,
        {MulAdd(n, sphere.radius, sphere.center), normal, hn::Div(light.pmf, light.area)},
        {light.radiance, two_sided});
  }
  // Outside: cone sampling, kept where it applies.
  const VF cap = OneMinusCosCone(sphere.radius, d2);
  const VF one_minus_cos = hn::Mul(u0, cap);
  const VF sin_theta =
      hn::Sqrt(hn::Mul(one_minus_cos, hn::Sub(Splat(2.0f), one_minus_cos)));
  const ShadingFrame frame = FrameFromNormal(Normalize(to_center));
  const V3 w = frame.FromLocal({hn::Mul(sin_theta, cosine), hn::Mul(sin_theta, sine),
                                hn::Sub(Splat(1.0f), one_minus_cos)});
  const VF pdf = hn::Div(light.pmf, hn::Mul(Splat(two_pi), cap));
  const VF near = NearDistance(to_center, w, sphere.radius);
  const VF distance = hn::Max(
      hn::Sub(near, hn::MulAdd(Splat(2e-6f), hn::Add(SumAbs(from), SumAbs(sphere.center)),
                               hn::Mul(Splat(2.0f), Gather(p.p_error, slots)))),
      hn::Mul(near, Splat(0.5f)));
  const MF facing = hn::Or(hn::Gt(sphere.normal_sign, Splat(0)), two_sided);
  const V3 radiance =
      IfThenElseZero(facing, Mul(light.radiance, hn::Div(Splat(1.0f), pdf)));
  const bool mixed = !hn::AllTrue(DF(), outside);
  const auto keep = [&](VF value, float* column) HWY_ATTR {
    if (mixed) value = hn::IfThenElse(outside, value, Gather(column, slots));
    Scatter(value, column, slots);
  };
  keep(w.x, p.ls_x);
  keep(w.y, p.ls_y);
  keep(w.z, p.ls_z);
  keep(distance, p.ls_distance);
  keep(radiance.x, p.ls_r);
  keep(radiance.y, p.ls_g);
  keep(radiance.z, p.ls_b);
  keep(pdf, p.ls_pdf);
}

template <bool kMany>
void SampleSphereLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  if (scene.lights->lights.size() <= hn::Lanes(DF()) && IsPmfConstant(wave)) {
    // Records are read once per call; batches choose among them in registers.
    const SphereEmitters all = SphereEmitters::All(wave);
    ForEachLit<kMany>(wave, LightShape::kSphere,
                      [&](const StoreSlots& slots, VI index)
                          HWY_ATTR { SampleEmitters(p, slots, all.Choose(index)); });
    return;
  }
  ForEachLit<kMany>(
      wave, LightShape::kSphere, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(scene, index);
        SampleEmitters(p, slots,
                       {scene, light, light.Primitive(), Pmf(wave, slots, index)});
      });
}

Stage SampleSphereLightStage() {
  return SampleLightStage(
      "light_sphere", "samples emitting spheres", Feature::kSphereLights,
      ByFeature<Feature::kManyLights, SampleSphereLight<true>, SampleSphereLight<false>>);
}

template <bool kMany>
void SampleDiskLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kDisk, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const LightDisk disk(wave, light.Primitive());
        // r^2 is uniform between the squares of the radii.
        const VF inner2 = hn::Mul(disk.inner_radius, disk.inner_radius);
        const VF span = hn::NegMulAdd(disk.inner_radius, disk.inner_radius,
                                      hn::Mul(disk.radius, disk.radius));
        const VF r = hn::Sqrt(hn::MulAdd(Gather(p.u_light_0, slots), span, inner2));
        const auto [sine, cosine] = SinCos2Pi(Gather(p.u_light_1, slots));
        const V3 v_axis = Cross(disk.n, disk.u_axis);
        const V3 q = MulAdd(disk.u_axis, hn::Mul(r, cosine),
                            MulAdd(v_axis, hn::Mul(r, sine), disk.center));
        StoreSurfaceSample(p, slots,
                           {q, disk.n, hn::Div(Pmf(wave, slots, index), light.Area())},
                           {light.Radiance(), light.TwoSided()});
      });
}

Stage SampleDiskLightStage() {
  return SampleLightStage(
      "light_disk", "samples emitting disks", Feature::kDiskLights,
      ByFeature<Feature::kManyLights, SampleDiskLight<true>, SampleDiskLight<false>>);
}

LANELIGHT_END_KERNELS
