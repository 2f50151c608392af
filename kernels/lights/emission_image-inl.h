// Emitting shapes with an image of their radiance: surface coordinates at points of
// lights, and what is emitted there.
#ifndef LANELIGHT_LIGHTS_EMISSION_IMAGE_INL_H_
#define LANELIGHT_LIGHTS_EMISSION_IMAGE_INL_H_

#include "kernels/lights/geometry-inl.h"
#include "kernels/lights/light_image-inl.h"
#include "kernels/surface/store-inl.h"

LANELIGHT_BEGIN_KERNELS

struct LightUv {
  VF u, v;
};

/// Interpolates by the barycentric weights of the second and third vertex; without uvs
/// between (0,0), (1,0), (1,1), as in pbrt.
LANELIGHT_INLINE LightUv TriangleUv(const Geometry& geometry, VI prim, VF b1, VF b2) {
  if (geometry.uvs.empty()) return {hn::Add(b1, b2), b2};
  const float* uvs = geometry.uvs.data();
  const VI at = hn::Mul(prim, hn::Set(DI(), 6));
  const auto interpolate = [&](int axis) HWY_ATTR {
    const VF a = Gather(uvs + axis, at), b = Gather(uvs + 2 + axis, at);
    const VF c = Gather(uvs + 4 + axis, at);
    return hn::MulAdd(b1, hn::Sub(b, a), hn::MulAdd(b2, hn::Sub(c, a), a));
  };
  return {interpolate(0), interpolate(1)};
}

/// Of a direction `out` from the centre, unit.
LANELIGHT_INLINE LightUv SphereUv(const SceneParts& scene, VI prim, V3 out) {
  const VI index =
      hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.ranges->spheres)));
  const RecordWords record(scene.geometry->spheres.data(), index);
  const V3 x_axis = record.F3(offsetof(SphereRecord, x_axis));
  const V3 z_axis = record.F3(offsetof(SphereRecord, z_axis));
  const VF y_sign = record.F(offsetof(SphereRecord, y_sign));
  const VF x = Dot(out, x_axis), y = hn::Mul(Dot(out, Cross(z_axis, x_axis)), y_sign);
  const VF across = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
  const VF theta = TurnFraction(across, Dot(out, z_axis));
  return {TurnFraction(y, x), hn::NegMulAdd(Splat(2.0f), theta, Splat(1.0f))};
}

/// `rel`: from the centre.
LANELIGHT_INLINE LightUv DiskUv(const SceneParts& scene, VI prim, const LightDisk& disk,
                                V3 rel) {
  const VI index =
      hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.ranges->disks)));
  const RecordWords record(scene.geometry->disks.data(), index);
  const VF v_sign = record.F(offsetof(DiskRecord, v_sign));
  const VF x = Dot(rel, disk.u_axis);
  const VF y = hn::Mul(Dot(rel, Cross(disk.n, disk.u_axis)), v_sign);
  const VF distance = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
  const VF width = hn::Sub(disk.radius, disk.inner_radius);
  return {TurnFraction(y, x), hn::Div(hn::Sub(disk.radius, distance), width)};
}

/// What the image of each light has at these coordinates, as pbrt looks it up: bilinear,
/// v upwards; 1 for lights without one.
LANELIGHT_INLINE V3 ImageAt(const SceneParts& scene, const Lights& light, LightUv at) {
  const LightImages images(*scene.lights, light.I(offsetof(LightRecord, image)));
  return images.Bilinear(at.u, hn::Sub(Splat(1.0f), at.v));
}

LANELIGHT_END_KERNELS

#endif
