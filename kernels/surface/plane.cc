// The surface at hits on planes.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/surface/store-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE void PlaneBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const DI di;
  const auto first = static_cast<int32_t>(geometry.ranges.planes);
  const VI index = hn::Sub(Gather(path.prim, slots), hn::Set(di, first));
  const RecordWords record(geometry.planes.data(), index);
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

LANELIGHT_END_KERNELS
