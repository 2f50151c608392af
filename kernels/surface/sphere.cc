// The surface at hits on spheres and large spheres.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/store-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

struct SphereHits {
  V3 center;
  VF radius;
};

// The hit moved radially onto the sphere, and the unit vector from the centre.
template <bool kUpper>
HWY_INLINE void Reproject(const SphereHits& s, D3 hit, D3& p, D3& outward) {
  const D3 center = HalfOf<kUpper>(s.center), rel = Minus(hit, center);
  const VD inverse = hn::Div(hn::Set(DD(), 1.0), hn::Sqrt(Dot(rel, rel)));
  outward = {hn::Mul(rel.x, inverse), hn::Mul(rel.y, inverse), hn::Mul(rel.z, inverse)};
  p = MulAdd(outward, HalfOf<kUpper>(s.radius), center);
}

HWY_INLINE void SphereBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const RecordWords record =
      HitRecords(geometry.spheres, Gather(path.prim, slots), geometry.ranges.spheres);
  const SphereHits s{record.F3(offsetof(SphereRecord, center)),
                     record.F(offsetof(SphereRecord, radius))};
  D3 p[2], outward[2];
  Reproject<false>(s, RayPoint<false>(path, slots), p[0], outward[0]);
  Reproject<true>(s, RayPoint<true>(path, slots), p[1], outward[1]);
  const V3 out = FromHalves(outward[0], outward[1]);
  SurfaceLanes surface{.p = FromHalves(p[0], p[1]),
                       .n = Mul(out, record.F(offsetof(SphereRecord, normal_sign))),
                       .error = Splat(0),
                       .material = record.I(offsetof(SphereRecord, material))};
  surface.error = RoundingError(surface.p, out, s.radius);
  StoreSurface(path, slots, surface);
  StoreSphereCoordinates(
      path, slots, record,
      {out, s.radius, hn::Mul(s.radius, Splat(2 * std::numbers::pi_v<float>))});
}

Stage SurfaceSphereStage() {
  return ShapeStage("surface_sphere", "point, normals and material of hits on spheres",
                    Feature::kSpheres,
                    Always<SurfaceOfShape<SphereBatch, &PrimitiveRanges::spheres,
                                          &PrimitiveRanges::disks>>);
}

struct LargeSphereHits {
  V3 point, normal;
  VF curvature;
};

// The hit moved onto the sphere along its gradient, the unit vector away from the centre,
// and how far from the record's point that is. With g the gradient and m that at the
// point, the height over the sphere is (|g| - |m|) / curvature, written without
// cancellation.
template <bool kUpper>
HWY_INLINE void Reproject(const LargeSphereHits& s, D3 hit, D3& p, D3& outward,
                          VD& size) {
  const D3 m = HalfOf<kUpper>(s.normal), q = Minus(hit, HalfOf<kUpper>(s.point));
  const VD curvature = HalfOf<kUpper>(s.curvature);
  const D3 g = MulAdd(q, curvature, m);
  const D3 sum = {hn::Add(m.x, g.x), hn::Add(m.y, g.y), hn::Add(m.z, g.z)};
  const VD length = hn::Sqrt(Dot(g, g));
  const VD height = hn::Div(Dot(q, sum), hn::Add(length, hn::Sqrt(Dot(m, m))));
  const VD inverse = hn::Div(hn::Set(DD(), 1.0), length);
  outward = {hn::Mul(g.x, inverse), hn::Mul(g.y, inverse), hn::Mul(g.z, inverse)};
  p = MulAdd(outward, hn::Neg(height), hit);
  size = hn::Sqrt(Dot(q, q));
}

HWY_INLINE void LargeSphereBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const RecordWords record = HitRecords(geometry.large_spheres, Gather(path.prim, slots),
                                        geometry.ranges.large_spheres);
  const LargeSphereHits s{record.F3(offsetof(LargeSphereRecord, point)),
                          record.F3(offsetof(LargeSphereRecord, normal)),
                          record.F(offsetof(LargeSphereRecord, curvature))};
  D3 p[2], outward[2];
  VD size[2];
  Reproject<false>(s, RayPoint<false>(path, slots), p[0], outward[0], size[0]);
  Reproject<true>(s, RayPoint<true>(path, slots), p[1], outward[1], size[1]);
  const V3 out = FromHalves(outward[0], outward[1]);
  SurfaceLanes surface{.p = FromHalves(p[0], p[1]),
                       .n = Mul(out, record.F(offsetof(LargeSphereRecord, normal_sign))),
                       .error = Splat(0),
                       .material = record.I(offsetof(LargeSphereRecord, material))};
  surface.error = RoundingError(surface.p, out, FromHalves(size[0], size[1]));
  StoreSurface(path, slots, surface);
  StoreSphereCoordinates(path, slots, record,
                         {out, hn::Div(Splat(1.0f), s.curvature),
                          hn::Div(Splat(2 * std::numbers::pi_v<float>), s.curvature)});
}

Stage SurfaceLargeSphereStage() {
  return ShapeStage(
      "surface_large_sphere", "point, normals and material of hits on large spheres",
      Feature::kLargeSpheres,
      Always<SurfaceOfShape<LargeSphereBatch, &PrimitiveRanges::large_spheres,
                            &PrimitiveRanges::curves>>);
}

LANELIGHT_END_KERNELS
