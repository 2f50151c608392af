// The surface at hits on planes and disks.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/store-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE void PlaneBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const RecordWords record =
      HitRecords(geometry.planes, Gather(path.prim, slots), geometry.ranges.planes);
  const V3 point = record.F3(offsetof(PlaneRecord, point));
  const V3 n = record.F3(offsetof(PlaneRecord, normal));
  const D3 lower = ProjectToPlane<false>(RayPoint<false>(path, slots), point, n);
  const D3 upper = ProjectToPlane<true>(RayPoint<true>(path, slots), point, n);
  SurfaceLanes surface{.p = FromHalves(lower, upper),
                       .n = n,
                       .error = Splat(0),
                       .material = record.I(offsetof(PlaneRecord, material))};
  const V3 rel = surface.p - point;
  surface.error = RoundingError(surface.p, n, MaxComponent(Abs(rel)));
  StoreSurface(path, slots, surface);
  if (path.tg_x != nullptr || path.uv_u != nullptr) {
    const V3 u_axis = record.F3(offsetof(PlaneRecord, u_axis));
    const V3 v_axis = record.F3(offsetof(PlaneRecord, v_axis));
    if (path.uv_u != nullptr) {
      Scatter(Dot(rel, u_axis), path.uv_u, slots);
      Scatter(Dot(rel, v_axis), path.uv_v, slots);
    }
    if (path.tg_x != nullptr) {
      // In the plane, across v, and one unit of u long.
      const V3 across = Cross(v_axis, n);
      const VF length = Dot(across, u_axis);
      const V3 tangent = Mul(across, hn::Div(Splat(1.0f), length));
      Scatter3(tangent, path.tg_x, path.tg_y, path.tg_z, slots);
      if (path.tv_x != nullptr) {
        const V3 across_u = Cross(u_axis, n);
        const VF inverse = hn::Div(Splat(1.0f), Dot(across_u, v_axis));
        StoreBitangent(path, slots, Mul(across_u, inverse), n);
      }
    }
  }
}

Stage SurfacePlaneStage() {
  return ShapeStage("surface_plane", "point, normals and material of hits on planes",
                    Feature::kPlanes,
                    Always<SurfaceOfShape<PlaneBatch, &PrimitiveRanges::planes,
                                          &PrimitiveRanges::large_spheres>>);
}

HWY_INLINE void DiskBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const RecordWords record =
      HitRecords(geometry.disks, Gather(path.prim, slots), geometry.ranges.disks);
  const V3 center = record.F3(offsetof(DiskRecord, center));
  const V3 n = record.F3(offsetof(DiskRecord, normal));
  const VF radius = record.F(offsetof(DiskRecord, radius));
  const D3 lower = ProjectToPlane<false>(RayPoint<false>(path, slots), center, n);
  const D3 upper = ProjectToPlane<true>(RayPoint<true>(path, slots), center, n);
  SurfaceLanes surface{.p = FromHalves(lower, upper),
                       .n = n,
                       .error = Splat(0),
                       .material = record.I(offsetof(DiskRecord, material))};
  surface.error = RoundingError(surface.p, n, radius);
  StoreSurface(path, slots, surface);
  if (path.tg_x != nullptr || path.uv_u != nullptr) {
    const V3 u_axis = record.F3(offsetof(DiskRecord, u_axis));
    const V3 v_axis = Mul(Cross(n, u_axis), record.F(offsetof(DiskRecord, v_sign)));
    const V3 rel = surface.p - center;
    const VF x = Dot(rel, u_axis);
    const VF y = Dot(rel, v_axis);
    if (path.uv_u != nullptr) {
      const VF distance = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
      const VF width = hn::Sub(radius, record.F(offsetof(DiskRecord, inner_radius)));
      const VF v = hn::Div(hn::Sub(radius, distance), width);
      Scatter(TurnFraction(y, x), path.uv_u, slots);
      // A ring of width zero has no v; a comparison with NaN or inf fails.
      Scatter(hn::IfThenElseZero(hn::Lt(hn::Abs(v), Splat(2.0f)), v), path.uv_v, slots);
    }
    if (path.tg_x != nullptr) {
      const V3 around = MulAdd(v_axis, x, Mul(u_axis, hn::Neg(y)));
      const V3 tangent = Mul(around, Splat(2 * std::numbers::pi_v<float>));
      Scatter3(TangentOr(tangent, n), path.tg_x, path.tg_y, path.tg_z, slots);
      if (path.tv_x != nullptr) {
        // From the rim, v = 0, to the inner edge, v = 1.
        const VF width = hn::Sub(radius, record.F(offsetof(DiskRecord, inner_radius)));
        const VF distance2 = hn::MulAdd(x, x, hn::Mul(y, y));
        const V3 outward = Mul(MulAdd(u_axis, x, Mul(v_axis, y)), Rsqrt(distance2));
        StoreBitangent(path, slots, Mul(outward, hn::Neg(width)), n);
      }
    }
  }
}

Stage SurfaceDiskStage() {
  return ShapeStage(
      "surface_disk", "point, normals and material of hits on disks", Feature::kDisks,
      Always<
          SurfaceOfShape<DiskBatch, &PrimitiveRanges::disks, &PrimitiveRanges::planes>>);
}

LANELIGHT_END_KERNELS
