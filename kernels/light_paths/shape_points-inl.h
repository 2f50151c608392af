// Points of emitting shapes at which light subpaths start, uniform over the area, and
// what the light's image and the shape's alpha leave of its radiance there.
#ifndef LANELIGHT_LIGHT_PATHS_SHAPE_POINTS_INL_H_
#define LANELIGHT_LIGHT_PATHS_SHAPE_POINTS_INL_H_

#include "kernels/lights/light_points-inl.h"
#include "kernels/light_paths/starts-inl.h"
#include "kernels/texture/mapping-inl.h"
#include "kernels/texture/texture-inl.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// A point of a light, with its normal.
struct EmittedFrom {
  V3 at, n;

  HWY_INLINE void Take(MF mask, V3 other_at, V3 other_n) {
    at = IfThenElse(mask, other_at, at);
    n = IfThenElse(mask, other_n, n);
  }
};

HWY_INLINE void TakeTriangle(const Wave& wave, const Lights& light, V2 u,
                             EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kTriangle);
  if (hn::AllFalse(DF(), mine)) return;
  const LightTriangle t(wave, PrimitiveOf(light, mine, 0));
  const VF root = hn::Sqrt(u.x);
  const V3 at = MulAdd(t.e1, hn::Mul(root, hn::Sub(Splat(1.0f), u.y)),
                       MulAdd(t.e2, hn::Mul(root, u.y), t.p0));
  from.Take(mine, at, t.n);
}

HWY_INLINE void TakeSphere(const Wave& wave, const Lights& light, V2 u,
                           EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kSphere);
  if (hn::AllFalse(DF(), mine)) return;
  const LightSphere sphere(wave, PrimitiveOf(light, mine, wave.ranges->spheres));
  const VF z = hn::NegMulAdd(Splat(2.0f), u.x, Splat(1.0f));
  const VF ring = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, Splat(1.0f)), Splat(0)));
  const auto [sine, cosine] = SinCos2Pi(u.y);
  const V3 n = {hn::Mul(ring, cosine), hn::Mul(ring, sine), z};
  from.Take(mine, MulAdd(n, sphere.radius, sphere.center), Mul(n, sphere.normal_sign));
}

HWY_INLINE void TakeDisk(const Wave& wave, const Lights& light, V2 u, EmittedFrom& from) {
  const MF mine = HasShape(light, LightShape::kDisk);
  if (hn::AllFalse(DF(), mine)) return;
  const LightDisk disk(wave, PrimitiveOf(light, mine, wave.ranges->disks));
  const VF inner2 = hn::Mul(disk.inner_radius, disk.inner_radius);
  const VF outer2 = hn::Mul(disk.radius, disk.radius);
  const VF r = hn::Sqrt(hn::MulAdd(u.x, hn::Sub(outer2, inner2), inner2));
  const auto [sine, cosine] = SinCos2Pi(u.y);
  const ShadingFrame frame = FrameFromNormal(disk.n);
  const V3 at = frame.FromLocal({hn::Mul(r, cosine), hn::Mul(r, sine), Splat(0)});
  from.Take(mine, disk.center + at, disk.n);
}

/// Returns a point of the light, uniform over its area, with the normal.
HWY_INLINE EmittedFrom PointOf(const Wave& wave, const Lights& light, V2 u) {
  const LightRectangle r(light);
  EmittedFrom from = {r.At(hn::Mul(u.x, r.size_x), hn::Mul(u.y, r.size_y)), r.n};
  if (hn::AllTrue(DF(), HasShape(light, LightShape::kRectangle))) return from;
  TakeTriangle(wave, light, u, from);
  TakeSphere(wave, light, u, from);
  TakeDisk(wave, light, u, from);
  return from;
}

/// Returns the surface coordinates of shapes at points `at`.
HWY_INLINE LightUv UvAtStart(const Wave& wave, const Lights& light, V3 at) {
  const SceneParts& scene = wave;
  LightUv uv = {Splat(0), Splat(0)};
  const auto take = [&](LightShape shape, uint32_t any, auto&& uv_of) HWY_ATTR {
    if (!wave.chances->emission.Has(shape)) return;
    const MF mine = HasShape(light, shape);
    const LightUv its = uv_of(PrimitiveOf(light, mine, any), mine);
    uv = {hn::IfThenElse(mine, its.u, uv.u), hn::IfThenElse(mine, its.v, uv.v)};
  };
  take(LightShape::kTriangle, 0, [&](VI prim, MF) HWY_ATTR {
    return UvOnTriangle(scene, LightTriangle(scene, prim), prim, at);
  });
  take(LightShape::kRectangle, 0, [&](VI prim, MF mine) HWY_ATTR {
    const VI second = hn::IfThenElseZero(
        hn::RebindMask(DI(), mine), light.I(offsetof(LightRecord, second_primitive)));
    return UvOnRectangle(scene, LightTriangle(scene, prim), prim, second, at);
  });
  take(LightShape::kSphere, scene.ranges->spheres, [&](VI prim, MF) HWY_ATTR {
    return SphereUv(scene, prim, Normalize(at - LightSphere(scene, prim).center));
  });
  take(LightShape::kDisk, scene.ranges->disks, [&](VI prim, MF) HWY_ATTR {
    const LightDisk disk(scene, prim);
    return DiskUv(scene, prim, disk, at - disk.center);
  });
  return uv;
}

/// Returns the image of shapes at points; 1 for lights without one.
HWY_INLINE V3 ImageAtStart(const Wave& wave, const Lights& light, LightUv uv) {
  const MF has_image = hn::Gt(light.Area(), hn::Zero(DF()));
  const VI image = hn::IfThenElseZero(hn::RebindMask(DI(), has_image),
                                      light.I(offsetof(LightRecord, image)));
  return LightImages(*wave.lights, image).Bilinear(uv.u, hn::Sub(Splat(1.0f), uv.v));
}

/// Returns the alpha of shapes at points: the share that rays meet.
HWY_INLINE VF AlphaAtStart(const Wave& wave, const Lights& light, LightUv uv,
                           const EmittedFrom& from) {
  const MF is_shape = hn::Gt(light.Area(), hn::Zero(DF()));
  const VI prim = hn::IfThenElseZero(hn::RebindMask(DI(), is_shape), light.Primitive());
  const PlacedPoint at = {uv.u, uv.v, from.at, from.n};
  const VF alpha = EvalFloats(*wave.textures, Gather(wave.alpha->texture.data(), prim),
                              at, Gather(wave.alpha->constant.data(), prim));
  return hn::Min(hn::Max(alpha, Splat(0)), Splat(1.0f));
}

/// Returns the share of a light's radiance that its shape sends at a point.
HWY_INLINE V3 ShareAtStart(const Wave& wave, const Lights& light,
                           const EmittedFrom& from) {
  const LightEmission& emission = wave.chances->emission;
  V3 share = Splat3(1, 1, 1);
  if (!emission.has_images && !emission.has_cuts) return share;
  const LightUv uv = UvAtStart(wave, light, from.at);
  if (emission.has_images) share = ImageAtStart(wave, light, uv);
  if (emission.has_cuts) share = Mul(share, AlphaAtStart(wave, light, uv, from));
  return share;
}

LANELIGHT_END_KERNELS

#endif
