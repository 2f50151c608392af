// The surface at hits on triangles.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/surface/triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/filter-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/surface/instance-inl.h"
#include "kernels/surface/point-inl.h"
#include "kernels/surface/stages.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector of hits: vertices in the space of the triangle, barycentric weights.
struct TriangleLanes {
  VI prim, material;
  V3 v0, v1, v2;
  VF b0, b1, b2;
};

HWY_INLINE TriangleLanes LoadTriangles(const Wave& wave, const Slots& slots) {
  const PathColumns& path = wave.path;
  const TriangleRecord* records = wave.scene->geometry.triangles.data();
  TriangleLanes tri;
  tri.prim = Gather(path.prim, slots);
  VF w[12];
  const Records triangles(records, 12, tri.prim);
  for (int i = 0; i < 12; i += 4) triangles.Load4(i, w + i);
  tri.v0 = {w[0], w[1], w[2]};
  tri.v1 = {w[3], w[4], w[5]};
  tri.v2 = {w[6], w[7], w[8]};
  tri.material = hn::BitCast(DI(), w[offsetof(TriangleRecord, material) / 4]);
  tri.b1 = Gather(path.b1, slots);
  tri.b2 = Gather(path.b2, slots);
  tri.b0 = hn::Sub(hn::Sub(Splat(1.0f), tri.b1), tri.b2);
  return tri;
}

// v0 + b1 (v1 - v0) + b2 (v2 - v0), on the plane of the vertices within 2^-50 of its
// size.
template <bool kUpper>
HWY_INLINE D3 Interpolate(const TriangleLanes& tri) {
  const D3 v0 = HalfOf<kUpper>(tri.v0);
  const D3 e1 = Minus(HalfOf<kUpper>(tri.v1), v0), e2 = Minus(HalfOf<kUpper>(tri.v2), v0);
  return MulAdd(e1, HalfOf<kUpper>(tri.b1), MulAdd(e2, HalfOf<kUpper>(tri.b2), v0));
}

// v times a power of two, exactly, with a largest |component| in [1, 2).
HWY_INLINE V3 ScaleToUnit(V3 v) {
  const DI di;
  const VI bits = hn::BitCast(di, MaxComponent(Abs(v)));
  const VI exponent = hn::And(bits, hn::Set(di, 0x7f800000));
  return Mul(v, hn::BitCast(DF(), hn::Sub(hn::Set(di, 0x7f000000), exponent)));
}

// Unit cross(v1 - v0, v2 - v0). Edges are scaled first: the product of tiny ones would
// underflow.
HWY_INLINE V3 FaceNormal(V3 e1, V3 e2) {
  return Normalize(Cross(ScaleToUnit(e1), ScaleToUnit(e2)));
}

// Interpolated vertex normal, unit, in the space of the triangle; `face` where the
// normals cancel.
HWY_INLINE V3 VertexNormal(const Geometry& geometry, const TriangleLanes& tri, V3 face) {
  const Records normals(geometry.normals.data(), 9, tri.prim);
  VF w[12];  // words 0 .. 7 and, not to read beyond the last record, 5 .. 8
  normals.Load4(0, w);
  normals.Load4(4, w + 4);
  normals.Load4(5, w + 8);
  const V3 n =
      MulAdd(V3{w[0], w[1], w[2]}, tri.b0,
             MulAdd(V3{w[3], w[4], w[5]}, tri.b1, Mul(V3{w[6], w[7], w[11]}, tri.b2)));
  return IfThenElse(hn::Gt(Dot(n, n), Splat(0x1p-40f)), n, face);
}

struct UvLanes {
  VF u[3], v[3];
};
HWY_INLINE UvLanes LoadUvs(const Geometry& geometry, VI prim) {
  const Records uvs(geometry.uvs.data(), 6, prim);
  VF first[4], last[4];  // u0 v0 u1 v1, u1 v1 u2 v2
  uvs.Load4(0, first);
  uvs.Load4(2, last);
  return {{first[0], first[2], last[2]}, {first[1], first[3], last[3]}};
}

// 0 < |v| < 1e15
HWY_INLINE MF IsUsable(V3 v) {
  const VF length2 = Dot(v, v);
  return hn::And(hn::Gt(length2, hn::Zero(DF())), hn::Lt(length2, Splat(1e30f)));
}

// dp/du in the space of the triangle: solves e_i = du_i dp/du + dv_i dp/dv. Where the
// coordinates are degenerate, any direction across the face normal.
HWY_INLINE V3 Tangent(const UvLanes& uv, V3 e1, V3 e2, V3 face) {
  const VF du1 = hn::Sub(uv.u[1], uv.u[0]), dv1 = hn::Sub(uv.v[1], uv.v[0]);
  const VF du2 = hn::Sub(uv.u[2], uv.u[0]), dv2 = hn::Sub(uv.v[2], uv.v[0]);
  const VF det = DifferenceOfProducts(du1, dv2, dv1, du2);
  const V3 scaled = {DifferenceOfProducts(dv2, e1.x, dv1, e2.x),
                     DifferenceOfProducts(dv2, e1.y, dv1, e2.y),
                     DifferenceOfProducts(dv2, e1.z, dv1, e2.z)};
  const V3 tangent = Mul(scaled, hn::Div(Splat(1.0f), det));
  return IfThenElse(IsUsable(tangent), tangent, FrameFromNormal(face).s);
}

// dp/dv likewise.
HWY_INLINE V3 Bitangent(const UvLanes& uv, V3 e1, V3 e2, V3 face) {
  const VF du1 = hn::Sub(uv.u[1], uv.u[0]), dv1 = hn::Sub(uv.v[1], uv.v[0]);
  const VF du2 = hn::Sub(uv.u[2], uv.u[0]), dv2 = hn::Sub(uv.v[2], uv.v[0]);
  const VF det = DifferenceOfProducts(du1, dv2, dv1, du2);
  const V3 scaled = {DifferenceOfProducts(du1, e2.x, du2, e1.x),
                     DifferenceOfProducts(du1, e2.y, du2, e1.y),
                     DifferenceOfProducts(du1, e2.z, du2, e1.z)};
  const V3 bitangent = Mul(scaled, hn::Div(Splat(1.0f), det));
  return IfThenElse(IsUsable(bitangent), bitangent, FrameFromNormal(face).t);
}

// Largest |coordinate| of the edges.
HWY_INLINE VF SizeOf(V3 e1, V3 e2) {
  return hn::Max(MaxComponent(Abs(e1)), MaxComponent(Abs(e2)));
}

// kFaceNormals: no mesh has normals, and shading normals, which a map will change, are
// those of the faces.
template <bool kNormals, bool kTangents, bool kUv, bool kInstances, bool kFaceNormals>
HWY_INLINE void SurfaceBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = wave.scene->geometry;
  const TriangleLanes tri = LoadTriangles(wave, slots);
  const V3 e1 = tri.v1 - tri.v0, e2 = tri.v2 - tri.v0;
  const V3 face = FaceNormal(e1, e2);
  InstanceMaps maps;
  V3 p, ng = face;
  VF error;
  if constexpr (kInstances) {
    maps = GatherMaps(geometry.instances, Gather(path.inst, slots));
    const D3 lower = Interpolate<false>(tri), upper = Interpolate<true>(tri);
    p = FromHalves(MapPoint<false>(maps.scene_from_object, lower),
                   MapPoint<true>(maps.scene_from_object, upper));
    ng = Normalize(maps.object_from_scene.Transposed(face));
    error = hn::Add(RoundingError(p, ng, hn::Zero(DF())),
                    MappingError(maps, FromHalves(lower, upper), ng));
  } else {
    p = FromHalves(Interpolate<false>(tri), Interpolate<true>(tri));
    error = RoundingError(p, ng, SizeOf(e1, e2));
  }
  if constexpr (kNormals) {
    V3 ns = face;
    if constexpr (!kFaceNormals) ns = VertexNormal(geometry, tri, face);
    if constexpr (kInstances) ns = maps.object_from_scene.Transposed(ns);
    ns = Normalize(ns);
    Scatter3(ns, path.ns_x, path.ns_y, path.ns_z, slots);
    // The geometric normal takes the side of the shading normal, as in pbrt.
    const MF apart = hn::Lt(Dot(ns, ng), hn::Zero(DF()));
    ng = IfThenElse(apart, -ng, ng);
  }
  Scatter3(p, path.p_x, path.p_y, path.p_z, slots);
  Scatter(error, path.p_error, slots);
  Scatter3(ng, path.ng_x, path.ng_y, path.ng_z, slots);
  Scatter(tri.material, path.material, slots);
  if constexpr (kUv || kTangents) {
    const UvLanes uv = LoadUvs(geometry, tri.prim);
    if constexpr (kUv) {
      const auto mix = [&](const VF* c) HWY_ATTR {
        return hn::MulAdd(c[0], tri.b0, hn::MulAdd(c[1], tri.b1, hn::Mul(c[2], tri.b2)));
      };
      Scatter(mix(uv.u), path.uv_u, slots);
      Scatter(mix(uv.v), path.uv_v, slots);
    }
    if constexpr (kTangents) {
      V3 tangent = Tangent(uv, e1, e2, face);
      if (path.tv_x != nullptr) {
        V3 bitangent = Bitangent(uv, e1, e2, face);
        if constexpr (kInstances) bitangent = maps.scene_from_object.Vector(bitangent);
        Scatter3(bitangent, path.tv_x, path.tv_y, path.tv_z, slots);
      }
      if constexpr (kInstances) tangent = maps.scene_from_object.Vector(tangent);
      Scatter3(tangent, path.tg_x, path.tg_y, path.tg_z, slots);
    }
  }
}

template <bool kNormals, bool kTangents, bool kUv, bool kInstances,
          bool kFaceNormals = false>
void SurfaceTriangle(Wave& wave) {
  const Queue& hits = FilterPrimitives(wave, wave.queue(QueueId::kSurface), 0,
                                       wave.scene->geometry.ranges.spheres);
  ForEachBatch(wave, hits, [&](const StoreSlots& slots, MF) HWY_ATTR {
    SurfaceBatch<kNormals, kTangents, kUv, kInstances, kFaceNormals>(wave, slots);
  });
}

// Picks the template variant, one feature at a time.
template <bool... kChosen>
StageFn Choose(const FeatureSet& features) {
  if constexpr (sizeof...(kChosen) == 4) {
    return SurfaceTriangle<kChosen...>;
  } else {
    const bool wanted[] = {features.Has(Feature::kVertexNormals), WantsTangents(features),
                           features.Has(Feature::kUv), features.Has(Feature::kInstances)};
    return wanted[sizeof...(kChosen)] ? Choose<kChosen..., true>(features)
                                      : Choose<kChosen..., false>(features);
  }
}

StageFn ChooseSurfaceTriangle(const FeatureSet& features) {
  if (WantsNormals(features) && !features.Has(Feature::kVertexNormals)) {
    // What changes normals needs tangents and surface coordinates.
    return features.Has(Feature::kInstances)
               ? SurfaceTriangle<true, true, true, true, true>
               : SurfaceTriangle<true, true, true, false, true>;
  }
  return Choose<>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/surface/stages.h"

namespace lanelight {
HWY_EXPORT(ChooseSurfaceTriangle);

Stage SurfaceTriangleStage() {
  return {.name = "surface_triangle",
          .meaning = "point, normals and material of hits on triangles",
          .input = QueueId::kSurface,
          .needs = {Feature::kTriangles, Feature::kScatters},
          .reads = {Field::prim, Field::b1, Field::b2, Field::inst},
          .writes = SurfaceFields(),
          .resolve = [](const FeatureSet& features) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(ChooseSurfaceTriangle)(features);
          }};
}

}  // namespace lanelight
#endif
