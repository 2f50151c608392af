// The surface at hits on triangles.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/instance-inl.h"

LANELIGHT_BEGIN_KERNELS

// A vector of hits: vertices in the space of the triangle, barycentric weights.
struct TriangleLanes {
  VI prim, material, flags;
  V3 v0, v1, v2;
  VF b0, b1, b2;
};

HWY_INLINE TriangleLanes LoadTriangles(const Wave& wave, const Slots& slots) {
  const PathColumns& path = wave.path;
  const TriangleRecord* records = wave.geometry->triangles.data();
  TriangleLanes tri;
  tri.prim = Gather(path.prim, slots);
  VF w[12];
  const Records triangles(records, 12, tri.prim);
  for (int i = 0; i < 12; i += 4) triangles.Load4(i, w + i);
  tri.v0 = {w[0], w[1], w[2]};
  tri.v1 = {w[3], w[4], w[5]};
  tri.v2 = {w[6], w[7], w[8]};
  tri.material = hn::BitCast(DI(), w[offsetof(TriangleRecord, material) / 4]);
  tri.flags = hn::BitCast(DI(), w[offsetof(TriangleRecord, flags) / 4]);
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

// Solves e_i = du_i dp/du + dv_i dp/dv in the space of the triangle. If the coordinates
// are degenerate, returns any directions across the face normal.
struct UvDerivatives {
  VF du1, dv1, du2, dv2, det;

  HWY_INLINE explicit UvDerivatives(const UvLanes& uv)
      : du1(hn::Sub(uv.u[1], uv.u[0])),
        dv1(hn::Sub(uv.v[1], uv.v[0])),
        du2(hn::Sub(uv.u[2], uv.u[0])),
        dv2(hn::Sub(uv.v[2], uv.v[0])),
        det(DifferenceOfProducts(du1, dv2, dv1, du2)) {}
  HWY_INLINE V3 Tangent(V3 e1, V3 e2, V3 face) const {
    return Combined(dv2, e1, dv1, e2, FrameFromNormal(face).s);
  }
  HWY_INLINE V3 Bitangent(V3 e1, V3 e2, V3 face) const {
    return Combined(du1, e2, du2, e1, FrameFromNormal(face).t);
  }

 private:
  HWY_INLINE V3 Combined(VF a, V3 v, VF b, V3 w, V3 otherwise) const {
    const V3 scaled = {DifferenceOfProducts(a, v.x, b, w.x),
                       DifferenceOfProducts(a, v.y, b, w.y),
                       DifferenceOfProducts(a, v.z, b, w.z)};
    const V3 solved = Mul(scaled, hn::Div(Splat(1.0f), det));
    return IfThenElse(IsUsable(solved), solved, otherwise);
  }
};

// v mirrored on the plane across `normal`.
HWY_INLINE V3 Mirrored(V3 v, V3 normal) {
  const VF fraction = hn::Div(Dot(v, normal), Dot(normal, normal));
  return MulAdd(normal, hn::Mul(Splat(-2.0f), fraction), v);
}

// Turns the tangents of bilinear patches with normals as their face's normal turns to the
// shading normal. As in pbrt-v4, two reflections about an axis far from both normals do
// this (Moeller and Hughes 1999, "Efficiently Building a Matrix to Rotate One Vector to
// Another").
HWY_NOINLINE void TurnTangents(const Geometry& geometry, const TriangleLanes& tri,
                               V3 face, V3& tangent, V3& bitangent) {
  const VI flag = hn::Set(DI(), static_cast<int32_t>(kRotatedTangents));
  const MF turned = hn::RebindMask(DF(), hn::Eq(hn::And(tri.flags, flag), flag));
  if (hn::AllFalse(DF(), turned) || geometry.normals.empty()) return;
  const V3 ns = Normalize(VertexNormal(geometry, tri, face));
  const auto far = [](VF a, VF b) HWY_ATTR {
    return hn::Lt(hn::Max(hn::Abs(a), hn::Abs(b)), Splat(0.72f));
  };
  const MF x = far(face.x, ns.x), y = hn::AndNot(x, far(face.y, ns.y));
  const VF one = Splat(1.0f);
  const V3 axis = {hn::IfThenElseZero(x, one), hn::IfThenElseZero(y, one),
                   hn::IfThenZeroElse(hn::Or(x, y), one)};
  const V3 first = axis - face, second = axis - ns;
  for (V3* v : {&tangent, &bitangent}) {
    *v = IfThenElse(turned, Mirrored(Mirrored(*v, first), second), *v);
  }
}

// Edges from the first vertex, and the unit normal of the face.
struct FaceLanes {
  V3 e1, e2, normal;
};

struct UvFaceLanes {
  const UvLanes& uv;
  const FaceLanes& face;
};

// The point of a hit in the scene, and the maps of its triangle.
struct PlaceLanes {
  V3 p, ng;
  VF error;
  InstanceMaps maps;
};

// Replaces places at the opening of the shutter by those at the times of the paths.
HWY_NOINLINE void MovePlaces(const Wave& wave, const StoreSlots& slots,
                             const TriangleLanes& tri, V3 face, PlaceLanes& at) {
  const MovingLanes moving =
      GatherMotions(wave.geometry->motions, Gather(wave.path.inst, slots),
                    Gather(wave.path.time, slots));
  const D3 lower = Interpolate<false>(tri), upper = Interpolate<true>(tri);
  const V3 p = FromHalves(MapPoint<false>(moving.maps.scene_from_object, lower),
                          MapPoint<true>(moving.maps.scene_from_object, upper));
  const V3 ng = Normalize(moving.maps.object_from_scene.Transposed(face));
  const VF error = hn::Add(RoundingError(p, ng, hn::Zero(DF())),
                           MovingError(moving, FromHalves(lower, upper), ng));
  at.p = IfThenElse(moving.moves, p, at.p);
  at.ng = IfThenElse(moving.moves, ng, at.ng);
  at.error = hn::IfThenElse(moving.moves, error, at.error);
  at.maps.Replace(moving.moves, moving.maps);
}

// kMoving: some instances move.
template <bool kInstances, bool kMoving>
HWY_INLINE PlaceLanes PlaceTriangles(const Wave& wave, const StoreSlots& slots,
                                     const TriangleLanes& tri, const FaceLanes& face) {
  PlaceLanes at;
  if constexpr (kInstances) {
    at.maps = GatherMaps(wave.geometry->instances, Gather(wave.path.inst, slots));
    const D3 lower = Interpolate<false>(tri), upper = Interpolate<true>(tri);
    at.p = FromHalves(MapPoint<false>(at.maps.scene_from_object, lower),
                      MapPoint<true>(at.maps.scene_from_object, upper));
    at.ng = Normalize(at.maps.object_from_scene.Transposed(face.normal));
    at.error = hn::Add(RoundingError(at.p, at.ng, hn::Zero(DF())),
                       MappingError(at.maps, FromHalves(lower, upper), at.ng));
    if constexpr (kMoving) MovePlaces(wave, slots, tri, face.normal, at);
  } else {
    at.p = FromHalves(Interpolate<false>(tri), Interpolate<true>(tri));
    at.ng = face.normal;
    const VF size = hn::Max(MaxComponent(Abs(face.e1)), MaxComponent(Abs(face.e2)));
    at.error = RoundingError(at.p, face.normal, size);
  }
  return at;
}

// Shading normals: of the vertices or, where no mesh has any and a map will change them,
// of the faces. The geometric normal takes their side, as in pbrt.
template <bool kInstances>
HWY_INLINE void StoreNormals(const Wave& wave, const StoreSlots& slots,
                             const TriangleLanes& tri, V3 face, PlaceLanes* at) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  V3 ns = face;
  if (!geometry.normals.empty()) ns = VertexNormal(geometry, tri, face);
  if constexpr (kInstances) ns = at->maps.object_from_scene.Transposed(ns);
  ns = Normalize(ns);
  Scatter3(ns, path.ns_x, path.ns_y, path.ns_z, slots);
  const MF apart = hn::Lt(Dot(ns, at->ng), hn::Zero(DF()));
  at->ng = IfThenElse(apart, -at->ng, at->ng);
}

HWY_INLINE void StoreUvs(const PathColumns& path, const StoreSlots& slots,
                         const TriangleLanes& tri, const UvLanes& uv) {
  const auto mix = [&](const VF* c) HWY_ATTR {
    return hn::MulAdd(c[0], tri.b0, hn::MulAdd(c[1], tri.b1, hn::Mul(c[2], tri.b2)));
  };
  Scatter(mix(uv.u), path.uv_u, slots);
  Scatter(mix(uv.v), path.uv_v, slots);
}

template <bool kInstances>
HWY_INLINE void StoreTangents(const Wave& wave, const StoreSlots& slots,
                              const TriangleLanes& tri, const UvFaceLanes& flat,
                              const PlaceLanes& at) {
  const PathColumns& path = wave.path;
  const auto& [uv, face] = flat;
  const UvDerivatives solved(uv);
  V3 tangent = solved.Tangent(face.e1, face.e2, face.normal), bitangent = tangent;
  if (path.tv_x != nullptr) {
    bitangent = solved.Bitangent(face.e1, face.e2, face.normal);
  }
  if (wave.geometry->rotated_tangents) {
    TurnTangents(*wave.geometry, tri, face.normal, tangent, bitangent);
  }
  if (path.tv_x != nullptr) {
    if constexpr (kInstances) bitangent = at.maps.scene_from_object.Vector(bitangent);
    Scatter3(bitangent, path.tv_x, path.tv_y, path.tv_z, slots);
  }
  if constexpr (kInstances) tangent = at.maps.scene_from_object.Vector(tangent);
  Scatter3(tangent, path.tg_x, path.tg_y, path.tg_z, slots);
}

template <bool kInstances>
HWY_INLINE void StoreCoordinates(const Wave& wave, const StoreSlots& slots,
                                 const TriangleLanes& tri, const FaceLanes& face,
                                 const PlaceLanes& at) {
  const PathColumns& path = wave.path;
  const Geometry& geometry = *wave.geometry;
  const bool wanted = path.uv_u != nullptr || path.tg_x != nullptr;
  if (!wanted || geometry.uvs.empty()) return;
  const UvLanes uv = LoadUvs(geometry, tri.prim);
  if (path.uv_u != nullptr) StoreUvs(path, slots, tri, uv);
  if (path.tg_x != nullptr) StoreTangents<kInstances>(wave, slots, tri, {uv, face}, at);
}

template <bool kInstances, bool kMoving, bool kDetails>
HWY_INLINE void SurfaceBatch(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const TriangleLanes tri = LoadTriangles(wave, slots);
  const V3 e1 = tri.v1 - tri.v0, e2 = tri.v2 - tri.v0;
  const FaceLanes face = {e1, e2, FaceNormal(e1, e2)};
  PlaceLanes at = PlaceTriangles<kInstances, kMoving>(wave, slots, tri, face);
  if constexpr (kDetails) {
    if (path.ns_x != nullptr)
      StoreNormals<kInstances>(wave, slots, tri, face.normal, &at);
    StoreCoordinates<kInstances>(wave, slots, tri, face, at);
  }
  Scatter3(at.p, path.p_x, path.p_y, path.p_z, slots);
  Scatter(at.error, path.p_error, slots);
  Scatter3(at.ng, path.ng_x, path.ng_y, path.ng_z, slots);
  Scatter(tri.material, path.material, slots);
}

template <bool kInstances, bool kMoving>
void SurfaceTriangle(Wave& wave) {
  const Queue& hits =
      FilterPrimitives(wave, wave.queue(QueueId::kSurface), 0, wave.ranges->spheres);
  // Optional columns are tested per vector (store-inl.h), unless there is none.
  const PathColumns& path = wave.path;
  if (path.ns_x != nullptr || path.uv_u != nullptr || path.tg_x != nullptr) {
    ForEachBatch(wave, hits, [&](const StoreSlots& slots, MF) HWY_ATTR {
      SurfaceBatch<kInstances, kMoving, true>(wave, slots);
    });
  } else {
    ForEachBatch(wave, hits, [&](const StoreSlots& slots, MF) HWY_ATTR {
      SurfaceBatch<kInstances, kMoving, false>(wave, slots);
    });
  }
}

StageFn ResolveTriangles(const FeatureSet& features) {
  if (features.Has(Feature::kMovingInstances)) return SurfaceTriangle<true, true>;
  return features.Has(Feature::kInstances) ? SurfaceTriangle<true, false>
                                           : SurfaceTriangle<false, false>;
}

Stage SurfaceTriangleStage() {
  return {.name = "surface_triangle",
          .meaning = "point, normals and material of hits on triangles",
          .input = QueueId::kSurface,
          .role = StageRole::kSurface,
          .needs = {Feature::kTriangles, Feature::kScatters},
          .reads = {Field::prim, Field::b1, Field::b2, Field::inst, Field::time},
          .writes = kSurfaceFields,
          .resolve = ResolveTriangles};
}

LANELIGHT_END_KERNELS
