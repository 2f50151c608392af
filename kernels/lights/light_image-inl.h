// Images of lights: look-ups, one image per lane, and surface coordinates at points of
// emitting shapes.
#ifndef LANELIGHT_LIGHTS_LIGHT_IMAGE_INL_H_
#define LANELIGHT_LIGHTS_LIGHT_IMAGE_INL_H_

#include <cstddef>

#include "kernels/lights/geometry-inl.h"
#include "kernels/surface/store-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

/// The images of a vector of lanes, at (s, t) in [0, 1]^2 from the upper left corner.
/// Beyond the edges their texels repeat.
class LightImages : RecordWords<LightImage> {
 public:
  LANELIGHT_INLINE LightImages(const LightTable& table, VI image)
      : RecordWords(table.images.data(), image),
        texels_(table.texels.data()),
        first_(I(offsetof(LightImage, first))),
        width_(I(offsetof(LightImage, width))),
        height_(I(offsetof(LightImage, height))) {}

  /// Returns `away`, which points from the light, as (dot(x_axis, away), ...).
  LANELIGHT_INLINE V3 ToLocal(V3 away) const {
    return {Dot(F3(offsetof(LightImage, x_axis)), away),
            Dot(F3(offsetof(LightImage, y_axis)), away),
            Dot(F3(offsetof(LightImage, z_axis)), away)};
  }

  LANELIGHT_INLINE V3 Nearest(VF s, VF t) const {
    return Texel(ToIndex(Scaled(s, width_)), ToIndex(Scaled(t, height_)));
  }

  LANELIGHT_INLINE V3 Bilinear(VF s, VF t) const {
    const VI one = hn::Set(DI(), 1);
    const VF x = hn::Sub(Scaled(s, width_), Splat(0.5f));
    const VF y = hn::Sub(Scaled(t, height_), Splat(0.5f));
    const VI i = ToIndex(hn::Floor(x)), j = ToIndex(hn::Floor(y));
    const VF right = hn::Sub(x, hn::Floor(x)), below = hn::Sub(y, hn::Floor(y));
    const VI next_i = hn::Add(i, one), next_j = hn::Add(j, one);
    const V3 top = Mix(Texel(i, j), Texel(next_i, j), right);
    return Mix(top, Mix(Texel(i, next_j), Texel(next_i, next_j), right), below);
  }

 private:
  // Keeps integers in range; texels repeat beyond the edges.
  static LANELIGHT_INLINE VF Scaled(VF s, VI size) {
    return hn::Mul(hn::Min(hn::Max(s, Splat(-1.0f)), Splat(2.0f)),
                   hn::ConvertTo(DF(), size));
  }
  static LANELIGHT_INLINE VI ToIndex(VF x) { return hn::ConvertTo(DI(), x); }
  static LANELIGHT_INLINE V3 Mix(V3 a, V3 b, VF t) {
    return Mul(a, hn::Sub(Splat(1.0f), t)) + Mul(b, t);
  }
  LANELIGHT_INLINE V3 Texel(VI column, VI row) const {
    const VI zero = hn::Zero(DI()), one = hn::Set(DI(), 1);
    const VI x = hn::Min(hn::Max(column, zero), hn::Sub(width_, one));
    const VI y = hn::Min(hn::Max(row, zero), hn::Sub(height_, one));
    return Gather3(texels_, hn::Add(first_, hn::Add(hn::Mul(y, width_), x)));
  }

  const float* texels_;
  VI first_, width_, height_;
};

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

/// Returns the coordinates in unit direction `out` from the centre.
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

/// Returns the coordinates at `rel` from the centre.
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

/// Returns the value of each light's image at these coordinates, as pbrt looks it up:
/// bilinear, v upwards; 1 for lights without an image.
LANELIGHT_INLINE V3 ImageAt(const SceneParts& scene, const Lights& light, LightUv at) {
  const LightImages images(*scene.lights, light.I(offsetof(LightRecord, image)));
  return images.Bilinear(at.u, hn::Sub(Splat(1.0f), at.v));
}

LANELIGHT_END_KERNELS

#endif
