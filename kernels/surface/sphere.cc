// The surface at hits on spheres.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/surface/store-inl.h"
#include "kernels/surface/stages.h"
#include "src/compiled/scene.h"

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
  const Geometry& geometry = wave.scene->geometry;
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
  if (path.tg_x != nullptr || path.uv_u != nullptr) {
    const V3 x_axis = record.F3(offsetof(SphereRecord, x_axis));
    const V3 z_axis = record.F3(offsetof(SphereRecord, z_axis));
    const V3 y_axis =
        Mul(Cross(z_axis, x_axis), record.F(offsetof(SphereRecord, y_sign)));
    const VF x = Dot(out, x_axis);
    const VF y = Dot(out, y_axis);
    if (path.uv_u != nullptr) {
      // v = 1 - theta / pi, theta from the pole z; half a turn of (z, across).
      const VF z = Dot(out, z_axis);
      const VF across = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
      const VF theta = TurnFraction(across, z);
      Scatter(TurnFraction(y, x), path.uv_u, slots);
      Scatter(hn::NegMulAdd(Splat(2.0f), theta, Splat(1.0f)), path.uv_v, slots);
    }
    if (path.tg_x != nullptr) {
      const V3 around = MulAdd(y_axis, x, Mul(x_axis, hn::Neg(y)));
      const VF scale = hn::Mul(s.radius, Splat(2 * std::numbers::pi_v<float>));
      Scatter3(TangentOr(Mul(around, scale), out), path.tg_x, path.tg_y, path.tg_z,
               slots);
      if (path.tv_x != nullptr) {
        StoreBitangent(path, slots, SphereBitangent(out, z_axis, s.radius), out);
      }
    }
  }
}

void SurfaceSphere(Wave& wave) {
  const PrimitiveRanges& ranges = wave.scene->geometry.ranges;
  const Queue& hits =
      FilterPrimitives(wave, wave.queue(QueueId::kSurface), ranges.spheres, ranges.disks);
  ForEachBatch(wave, hits,
               [&](const StoreSlots& slots, MF) HWY_ATTR { SphereBatch(wave, slots); });
}

Stage SurfaceSphereStage() {
  return {.name = "surface_sphere",
          .meaning = "point, normals and material of hits on spheres",
          .input = QueueId::kSurface,
          .needs = {Feature::kSpheres, Feature::kScatters},
          .reads = fields::kRay | FieldSet{Field::t, Field::prim},
          .writes = SurfaceFields(),
          .resolve = Always<SurfaceSphere>};
}

LANELIGHT_END_KERNELS
