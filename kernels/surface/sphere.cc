// The surface at hits on spheres.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
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
  const DI di;
  const auto first = static_cast<int32_t>(geometry.ranges.spheres);
  const VI index = hn::Sub(Gather(path.prim, slots), hn::Set(di, first));
  const RecordWords record(geometry.spheres.data(), index);
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

LANELIGHT_END_KERNELS
