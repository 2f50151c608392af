// Emitting primitives: their geometry by record, and the densities of sampling them. The
// sampling kernels and the emission kernels use the same functions, so that the two sides
// of multiple importance sampling cannot disagree.
#ifndef LANELIGHT_LIGHTS_GEOMETRY_INL_H_
#define LANELIGHT_LIGHTS_GEOMETRY_INL_H_

#include "kernels/lights/light-inl.h"
#include "kernels/warp/solid_angle-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/scene_parts.h"

LANELIGHT_BEGIN_KERNELS

struct LightTriangle {
  V3 p0, e1, e2, n;

  LANELIGHT_INLINE LightTriangle(const SceneParts& scene, VI prim) {
    const RecordWords record(scene.geometry->triangles.data(), prim);
    p0 = record.F3(offsetof(TriangleRecord, p[0]));
    e1 = record.F3(offsetof(TriangleRecord, p[1])) - p0;
    e2 = record.F3(offsetof(TriangleRecord, p[2])) - p0;
    n = Normalize(Cross(e1, e2));
  }
};

struct LightRectangle {
  V3 corner, along_x, along_y, n;
  VF size_x, size_y;

  LANELIGHT_INLINE explicit LightRectangle(const Lights& light)
      : corner(light.F3(offsetof(LightRecord, position))),
        along_x(light.F3(offsetof(LightRecord, direction))),
        along_y(light.F3(offsetof(LightRecord, side))),
        n(Cross(along_x, along_y)),
        size_x(light.F(offsetof(LightRecord, size))),
        size_y(light.F(offsetof(LightRecord, size) + 4)) {}

  LANELIGHT_INLINE LocalRectangle From(V3 p) const {
    return {corner - p, along_x, along_y, n, size_x, size_y};
  }
  /// x, y: distances from the corner along the sides.
  LANELIGHT_INLINE V3 At(VF x, VF y) const {
    return MulAdd(along_x, x, MulAdd(along_y, y, corner));
  }
};

/// True where a triangle or rectangle is sampled by its solid angle; else by area.
LANELIGHT_INLINE MF BySolidAngle(VF omega) {
  return hn::Ge(omega, Splat(kMinSolidAngle));  // false for NaN
}

struct LightSphere {
  V3 center;
  VF radius, normal_sign;

  LANELIGHT_INLINE LightSphere(const SceneParts& scene, VI prim) {
    const VI index =
        hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.ranges->spheres)));
    const RecordWords record(scene.geometry->spheres.data(), index);
    center = record.F3(offsetof(SphereRecord, center));
    radius = record.F(offsetof(SphereRecord, radius));
    normal_sign = record.F(offsetof(SphereRecord, normal_sign));
  }
};

/// Returns 1 - cos of the half-angle under which a sphere is seen from squared distance
/// d2 > r^2, without cancellation for small spheres.
LANELIGHT_INLINE VF OneMinusCosCone(VF radius, VF d2) {
  const VF sin2 = hn::Min(hn::Div(hn::Mul(radius, radius), d2), Splat(1.0f));
  const VF cosine = hn::Sqrt(hn::Sub(Splat(1.0f), sin2));
  return hn::Div(sin2, hn::Add(Splat(1.0f), cosine));
}

struct LightDisk {
  V3 center, n, u_axis;
  VF radius, inner_radius;

  LANELIGHT_INLINE LightDisk(const SceneParts& scene, VI prim) {
    const VI index =
        hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.ranges->disks)));
    const RecordWords record(scene.geometry->disks.data(), index);
    center = record.F3(offsetof(DiskRecord, center));
    radius = record.F(offsetof(DiskRecord, radius));
    n = record.F3(offsetof(DiskRecord, normal));
    inner_radius = record.F(offsetof(DiskRecord, inner_radius));
    u_axis = record.F3(offsetof(DiskRecord, u_axis));
  }
};

LANELIGHT_END_KERNELS

#endif
