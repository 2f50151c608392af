// The area lights as a control variate sees them: which of them take part at a vertex,
// and the irradiance from those, unshadowed.
#ifndef LANELIGHT_CONTROL_AREA_LIGHTS_INL_H_
#define LANELIGHT_CONTROL_AREA_LIGHTS_INL_H_

#include "kernels/control/irradiance-inl.h"
#include "kernels/lights/geometry-inl.h"
#include "kernels/simd/math-inl.h"
#include "src/compiled/scene.h"

LANELIGHT_BEGIN_KERNELS

/// Irradiance from one light of radiance 1 on the two sides of a surface.
struct TwoSides {
  VF above, below;
};

/// Vertices that light arrives at: points with their rounding errors, and unit normals.
struct ReceiverLanes {
  V3 p;
  VF p_error;
  V3 n;
};

/// irradiance(half, p, n) of both halves of the vectors, for n and, with kBelow, for -n.
template <bool kBelow, class Irradiance>
LANELIGHT_INLINE TwoSides InHalves(const ReceiverLanes& at, Irradiance&& irradiance) {
  const D3 p0 = HalfOf<false>(at.p), p1 = HalfOf<true>(at.p);
  const D3 n0 = HalfOf<false>(at.n), n1 = HalfOf<true>(at.n);
  TwoSides out = {FromHalves(irradiance(p0, n0), irradiance(p1, n1)), Splat(0)};
  if constexpr (kBelow) {
    const VD flip = SplatD(-1);
    out.below =
        FromHalves(irradiance(p0, Scaled(n0, flip)), irradiance(p1, Scaled(n1, flip)));
  }
  return out;
}

/// Vertices clear of the plane of a light, on a side that it emits to: nearer ones are
/// lost in the rounding of the points of light samples (StoreSurfaceSample). Depends on
/// the vertex only, as everything that decides whether a light takes part.
LANELIGHT_INLINE MF ClearOfPlane(const ReceiverLanes& at, V3 point, V3 n, float size,
                                 const LightRecord& light) {
  const VF height = Dot(n, at.p - point);
  const VF reach = hn::Add(SumAbs(at.p), hn::Add(SumAbs(point), Splat(size)));
  const VF clear = hn::MulAdd(Splat(1e-5f), reach, hn::Mul(Splat(8.0f), at.p_error));
  return hn::Gt(light.two_sided != 0 ? hn::Abs(height) : height, clear);
}

/// One light for a vector of vertices: a triangle of it. Returns which of them it takes
/// part at.
template <bool kBelow>
LANELIGHT_INLINE MF TriangleLightAt(const CompiledScene& scene, uint32_t primitive,
                                    const LightRecord& light,
                                    const ReceiverLanes& receivers, TwoSides* out) {
  const TriangleRecord& record = scene.geometry.triangles[primitive];
  const auto corner = [&](int i) HWY_ATTR {
    return Splat3(record.p[i][0], record.p[i][1], record.p[i][2]);
  };
  const V3 e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
  const D3 c0 = SplatD3(record.p[0]), c1 = SplatD3(record.p[1]);
  const D3 e01 = Minus(c1, c0), e12 = Minus(SplatD3(record.p[2]), c1);
  const float size = hn::GetLane(hn::Add(SumAbs(e1), SumAbs(e2)));
  const V3 facing = Normalize(Cross(e1, e2));
  const MF clear = ClearOfPlane(receivers, corner(0), facing, size, light);
  if (hn::AllFalse(DF(), clear)) return clear;
  *out = InHalves<kBelow>(receivers, [&](D3 at, D3 normal) HWY_ATTR {
    return TriangleIrradiance({Minus(c0, at), e01, e12}, normal);
  });
  return clear;
}

/// Two triangles, of which rectangles consist as rays see them. Both take part or none.
template <bool kBelow>
LANELIGHT_INLINE MF RectangleLightAt(const CompiledScene& scene, const LightRecord& light,
                                     const ReceiverLanes& receivers, TwoSides* out) {
  TwoSides first = {Splat(0), Splat(0)}, second = first;
  const MF a = TriangleLightAt<kBelow>(scene, light.primitive, light, receivers, &first);
  const MF b =
      TriangleLightAt<kBelow>(scene, light.second_primitive, light, receivers, &second);
  *out = {hn::Add(first.above, second.above), hn::Add(first.below, second.below)};
  return hn::And(a, b);
}

/// From inside (as the sampler of spheres sees it) a sphere takes no part.
template <bool kBelow>
LANELIGHT_INLINE MF SphereLightAt(const CompiledScene& scene, const LightRecord& light,
                                  const ReceiverLanes& receivers, TwoSides* out) {
  const SphereRecord& record =
      scene.geometry.spheres[light.primitive - scene.geometry.ranges.spheres];
  const D3 center = SplatD3(record.center);
  const VD radius = SplatD(record.radius);
  *out = InHalves<kBelow>(receivers, [&](D3 at, D3 normal) HWY_ATTR {
    return SphereIrradiance(Minus(center, at), radius, normal);
  });
  const V3 to_center =
      Splat3(record.center[0], record.center[1], record.center[2]) - receivers.p;
  const bool emits = record.normal_sign > 0 || light.two_sided != 0;
  return hn::And(hn::Gt(Dot(to_center, to_center), Splat(light.size[0])),
                 hn::Eq(Splat(emits ? 1.0f : 0.0f), Splat(1.0f)));
}

/// A disk takes part where its rim does not cross the horizon of the vertex.
template <bool kBelow>
LANELIGHT_INLINE MF DiskLightAt(const CompiledScene& scene, const LightRecord& light,
                                const ReceiverLanes& receivers, TwoSides* out) {
  const DiskRecord& record =
      scene.geometry.disks[light.primitive - scene.geometry.ranges.disks];
  const D3 center = SplatD3(record.center), axis = SplatD3(record.normal);
  const VD outer = SplatD(record.radius), inner = SplatD(record.inner_radius);
  const V3 c = Splat3(record.center[0], record.center[1], record.center[2]);
  const V3 a = Splat3(record.normal[0], record.normal[1], record.normal[2]);
  const VF height = Dot(receivers.n, c - receivers.p), tilt = Dot(receivers.n, a);
  // Height of the rim's lowest and highest point over the centre.
  const VF sway = hn::Mul(Splat(record.radius * 1.00001f),
                          SafeSqrt(hn::NegMulAdd(tilt, tilt, Splat(1.000001f))));
  const MF above = hn::Gt(height, sway);
  const MF whole = hn::Gt(hn::Abs(height), sway);
  *out = InHalves<kBelow>(receivers, [&](D3 at, D3 normal) HWY_ATTR {
    const D3 to_center = Minus(center, at);
    const VD full = DiskIrradiance(to_center, axis, outer, normal);
    if (record.inner_radius == 0) return full;
    return hn::Sub(full, DiskIrradiance(to_center, axis, inner, normal));
  });
  out->above = hn::IfThenElseZero(above, out->above);
  out->below = hn::IfThenZeroElse(above, out->below);
  return hn::And(whole, ClearOfPlane(receivers, c, a, record.radius, light));
}

/// Sum over the area lights that take part.
struct AreaLight {
  V3 above, below;  // irradiance
  MF selected;      // the light that was sampled takes part
};

/// `selected`: light of the light sample of each path. as_carried(light, radiance): what
/// paths see of a light of this colour.
template <bool kBelow, class AsCarried>
LANELIGHT_INLINE AreaLight AreaLightsAt(const CompiledScene& scene,
                                        const ReceiverLanes& receivers, VI selected,
                                        const AsCarried& as_carried) {
  const V3 zero = Splat3(0, 0, 0);
  AreaLight sum = {zero, zero, hn::Lt(zero.x, zero.x)};
  for (std::size_t i = 0; i < scene.lights.lights.size(); ++i) {
    const LightRecord& light = scene.lights.lights[i];
    // Its radiance is not the same everywhere.
    if (light.image != 0 || IsCut(scene, light)) continue;
    TwoSides one = {zero.x, zero.x};
    MF takes_part;
    switch (static_cast<LightShape>(light.shape)) {
      case LightShape::kTriangle:
        takes_part =
            TriangleLightAt<kBelow>(scene, light.primitive, light, receivers, &one);
        break;
      case LightShape::kRectangle:
        takes_part = RectangleLightAt<kBelow>(scene, light, receivers, &one);
        break;
      case LightShape::kSphere:
        takes_part = SphereLightAt<kBelow>(scene, light, receivers, &one);
        break;
      case LightShape::kDisk:
        takes_part = DiskLightAt<kBelow>(scene, light, receivers, &one);
        break;
      default:
        continue;
    }
    const VI me = hn::Set(DI(), static_cast<int32_t>(i));
    sum.selected = hn::Or(
        sum.selected, hn::And(takes_part, hn::RebindMask(DF(), hn::Eq(selected, me))));
    const V3 radiance =
        as_carried(me, Splat3(light.radiance[0], light.radiance[1], light.radiance[2]));
    sum.above = MulAdd(radiance, hn::IfThenElseZero(takes_part, one.above), sum.above);
    if constexpr (kBelow) {
      sum.below = MulAdd(radiance, hn::IfThenElseZero(takes_part, one.below), sum.below);
    }
  }
  return sum;
}

LANELIGHT_END_KERNELS

#endif
