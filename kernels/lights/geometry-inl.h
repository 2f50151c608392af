// Emitting primitives: their geometry by record, and the densities of sampling them. The
// sampling kernels and the emission kernels use the same functions, so that the two sides
// of multiple importance sampling cannot disagree.
#if defined(LANELIGHT_LIGHTS_GEOMETRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_LIGHTS_GEOMETRY_INL_H_
#undef LANELIGHT_LIGHTS_GEOMETRY_INL_H_
#else
#define LANELIGHT_LIGHTS_GEOMETRY_INL_H_
#endif

#include "kernels/lights/light-inl.h"
#include "kernels/warp/solid_angle-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct LightTriangle {
  V3 p0, e1, e2, n;

  LANELIGHT_INLINE LightTriangle(const CompiledScene& scene, VI prim) {
    const void* records = scene.geometry.triangles.data();
    p0 = GatherRecord3(records, 12, 0, prim);
    e1 = GatherRecord3(records, 12, 3, prim) - p0;
    e2 = GatherRecord3(records, 12, 6, prim) - p0;
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
  return hn::Ge(omega, Splat(kLeastSolidAngle));  // false for NaN
}

struct LightSphere {
  V3 center;
  VF radius, normal_sign;

  LANELIGHT_INLINE LightSphere(const CompiledScene& scene, VI prim) {
    const VI index =
        hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.geometry.ranges.spheres)));
    const float* words = reinterpret_cast<const float*>(scene.geometry.spheres.data());
    const VI at = hn::Mul(index, hn::Set(DI(), 16));
    center = {Gather(words, at), Gather(words + 1, at), Gather(words + 2, at)};
    radius = Gather(words + 3, at);
    normal_sign = Gather(words + offsetof(SphereRecord, normal_sign) / 4, at);
  }
};

/// 1 - cos of the half-angle under which a sphere is seen from squared distance d2 > r^2,
/// without cancellation for small spheres.
LANELIGHT_INLINE VF OneMinusCosCone(VF radius, VF d2) {
  const VF sin2 = hn::Min(hn::Div(hn::Mul(radius, radius), d2), Splat(1.0f));
  const VF cosine = hn::Sqrt(hn::Sub(Splat(1.0f), sin2));
  return hn::Div(sin2, hn::Add(Splat(1.0f), cosine));
}

/// True where a sphere is sampled by its cone of directions; inside, by area.
LANELIGHT_INLINE MF OutsideSphere(VF radius, VF d2) {
  return hn::Gt(d2, hn::Mul(hn::Mul(radius, radius), Splat(1.0001f)));
}

struct LightDisk {
  V3 center, n, u_axis;
  VF radius, inner_radius;

  LANELIGHT_INLINE LightDisk(const CompiledScene& scene, VI prim) {
    const VI index =
        hn::Sub(prim, hn::Set(DI(), static_cast<int32_t>(scene.geometry.ranges.disks)));
    const void* records = scene.geometry.disks.data();
    const float* words = static_cast<const float*>(records);
    const VI at = hn::Mul(index, hn::Set(DI(), 16));
    center = GatherRecord3(records, 16, 0, index);
    radius = Gather(words + 3, at);
    n = GatherRecord3(records, 16, 4, index);
    inner_radius = Gather(words + 7, at);
    u_axis = GatherRecord3(records, 16, 8, index);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
