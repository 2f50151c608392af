// Bump maps: the shading normal of a surface displaced along its normal by h(u, v) of the
// displacement texture, without moving the surface (Blinn 1978, "Simulation of Wrinkled
// Surfaces"). The conventions are those of pbrt-v4:
//   dp'/du = dp/du + (h(u + du, v) - h(u, v)) / du n,   likewise dp'/dv;
// the steps du, dv are half of the pixel's footprint, |du/dx| + |du/dy| over 2, or 0.0005
// where that is zero; the normal is their cross product, on the side of the geometric
// one. On meshes with vertex normals n is the interpolated normal, dp/du its part across
// n, and n x dp/du stands for dp/dv, whatever the length of that.
//
// pbrt-v4 adds h dn/du to dp'/du. It is left out here: it changes the slopes in the
// ratio of the height to the radius of curvature, and needs six more numbers per hit.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/surface/instance-inl.h"
#include "kernels/surface/mapped_normals-inl.h"
#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

// The surface before it is bumped.
struct BumpAxes {
  V3 n, u, v;  // normal, dp/du, dp/dv
};

// Lanes that lie on a triangle of a mesh with normals.
HWY_INLINE MF OnMeshWithNormals(const Geometry& geometry, VI prim) {
  const DI di;
  if (geometry.triangles.empty()) return hn::FirstN(DF(), 0);
  const auto end = static_cast<int32_t>(geometry.ranges.spheres);
  const auto triangle = hn::Lt(prim, hn::Set(di, end));
  const RecordWords record(geometry.triangles.data(), hn::IfThenElseZero(triangle, prim));
  const VI flags = record.I(offsetof(TriangleRecord, flags));
  const VI mesh_normals = hn::And(flags, hn::Set(di, static_cast<int32_t>(kMeshNormals)));
  return hn::RebindMask(DF(), hn::And(triangle, hn::Ne(mesh_normals, hn::Zero(di))));
}

// -1 where the instance mirrors: n x dp/du is taken in the space of the mesh.
template <bool kInstances>
HWY_INLINE VF Handedness(const Wave& wave, const StoreSlots& slots) {
  if constexpr (kInstances) {
    const InstanceMaps maps =
        GatherMaps(wave.geometry->instances, Gather(wave.path.inst, slots));
    const Map34& m = maps.scene_from_object;
    return hn::CopySign(Splat(1.0f), Dot(m.row[0], Cross(m.row[1], m.row[2])));
  }
  return Splat(1.0f);
}

template <bool kInstances>
HWY_INLINE BumpAxes LoadAxes(const Wave& wave, const StoreSlots& slots) {
  const PathColumns& path = wave.path;
  const V3 n = Gather3(path.ns_x, path.ns_y, path.ns_z, slots);
  const V3 tg = Gather3(path.tg_x, path.tg_y, path.tg_z, slots);
  const V3 tv = Gather3(path.tv_x, path.tv_y, path.tv_z, slots);
  const V3 flat = MulAdd(n, hn::Neg(Dot(n, tg)), tg);
  const V3 across = Mul(Cross(n, tg), Handedness<kInstances>(wave, slots));
  const MF square = OnMeshWithNormals(*wave.geometry, Gather(path.prim, slots));
  return {n, IfThenElse(square, flat, tg), IfThenElse(square, across, tv)};
}

// Half of the footprint, at least what floats resolve at large coordinates.
HWY_INLINE VF Step(VF d0, VF d1, VF at) {
  const VF half = hn::Mul(Splat(0.5f), hn::Add(hn::Abs(d0), hn::Abs(d1)));
  const VF step = hn::IfThenElse(hn::Gt(half, hn::Zero(DF())), half, Splat(0.0005f));
  return hn::Max(step, hn::Mul(Splat(0x1p-17f), hn::Max(hn::Abs(at), Splat(1.0f))));
}

// Slope of the height per unit of u and v, in scene units.
struct Slopes {
  VF u, v;
};
HWY_INLINE Slopes LoadSlopes(const Wave& wave, const StoreSlots& slots, VI texture) {
  const PathColumns& path = wave.path;
  const TextureTable& table = *wave.textures;
  const VF u = Gather(path.uv_u, slots), v = Gather(path.uv_v, slots);
  const Footprint footprint = LoadFootprint(path, slots);
  const VF next_u = hn::Add(u, Step(footprint.dudx, footprint.dudy, u));
  const VF next_v = hn::Add(v, Step(footprint.dvdx, footprint.dvdy, v));
  const V3 p = Gather3(path.p_x, path.p_y, path.p_z, slots);
  const V3 n = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
  const V3 tg = Gather3(path.tg_x, path.tg_y, path.tg_z, slots);
  const V3 tv = Gather3(path.tv_x, path.tv_y, path.tv_z, slots);
  const auto height = [&](VF at_u, VF at_v) HWY_ATTR {
    const V3 at = MulAdd(tg, hn::Sub(at_u, u), MulAdd(tv, hn::Sub(at_v, v), p));
    FilteredPoint point = {at_u, at_v, at, n, footprint, {}, {}};
    point.SetSteps(tg, tv);
    return EvalFloats(table, texture, point, hn::Zero(DF()));
  };
  const VF here = height(u, v), scale = Splat(static_cast<float>(wave.scale));
  const VF rise_u = hn::Sub(height(next_u, v), here);
  const VF rise_v = hn::Sub(height(u, next_v), here);
  return {hn::Mul(scale, hn::Div(rise_u, hn::Sub(next_u, u))),
          hn::Mul(scale, hn::Div(rise_v, hn::Sub(next_v, v)))};
}

template <bool kInstances>
void Bumps(Wave& wave) {
  const AlignedVector<int32_t>& textures = wave.materials->displacement_texture;
  const PathColumns& path = wave.path;
  ForEachBatch(wave, WithTexture(wave, textures),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 const VI texture = Lookup(textures, Gather(path.material, slots));
                 const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
                 const BumpAxes axes = LoadAxes<kInstances>(wave, slots);
                 const Slopes slope = LoadSlopes(wave, slots, texture);
                 // Normalized because products of small lengths would underflow.
                 const V3 along_u = MulAdd(axes.n, slope.u, axes.u);
                 const V3 along_v = MulAdd(axes.n, slope.v, axes.v);
                 const V3 n = Normalize(Cross(Normalize(along_u), Normalize(along_v)));
                 StoreNormal(wave, slots, Sided(n, ng, axes.n), ng, along_u);
               });
}

Stage BumpsStage() {
  return {.name = "bumps",
          .meaning = "computes shading normals of displacement textures",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kBumps, Feature::kScatters},
          .reads = kMappedNormalReads | fields::kFootprint |
                   FieldSet{Field::prim, Field::inst},
          .writes = kMappedNormalWrites,
          .resolve = ByFeature<Feature::kInstances, Bumps<true>, Bumps<false>>};
}

// Normal maps as in pbrt-v4 (bilinear, repeated, no levels): texel c holds the shading
// normal 2 c - 1 in the frame of dp/du across the normal, n x dp/du, and the normal.

// dp/du across n, unit; any direction across it where there is none.
HWY_INLINE V3 UnitTangent(V3 n, V3 tangent) {
  const V3 flat = MulAdd(n, hn::Neg(Dot(n, tangent)), tangent);
  const VF length2 = Dot(flat, flat);
  const MF usable = hn::Gt(length2, hn::Mul(Splat(1e-10f), Dot(tangent, tangent)));
  return IfThenElse(usable, Mul(flat, Rsqrt(length2)), FrameFromNormal(n).s);
}

void NormalMaps(Wave& wave) {
  const AlignedVector<int32_t>& textures = wave.materials->normal_map_texture;
  const PathColumns& path = wave.path;
  ForEachBatch(
      wave, WithTexture(wave, textures), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VI texture = Lookup(textures, Gather(path.material, slots));
        const V3 ng = Gather3(path.ng_x, path.ng_y, path.ng_z, slots);
        const V3 ns = Gather3(path.ns_x, path.ns_y, path.ns_z, slots);
        const V3 x = UnitTangent(ns, Gather3(path.tg_x, path.tg_y, path.tg_z, slots));
        const UvPoint at = {Gather(path.uv_u, slots), Gather(path.uv_v, slots)};
        const V3 color = EvalTextures(*wave.textures, texture, at, Splat3(0, 0, 0));
        const V3 local = Normalize(Mul(color, Splat(2.0f)) - Splat3(1, 1, 1));
        const V3 n = ShadingFrame{x, Cross(ns, x), ns}.FromLocal(local);
        StoreNormal(wave, slots, Sided(n, ng, ns), ng, x);
      });
}

Stage NormalMapsStage() {
  return {.name = "normal_maps",
          .meaning = "computes shading normals of normal maps",
          .input = QueueId::kSurface,
          .role = StageRole::kTexture,
          .needs = {Feature::kNormalMaps, Feature::kScatters},
          .reads = kMappedNormalReads,
          .writes = kMappedNormalWrites,
          .resolve = Always<NormalMaps>};
}

LANELIGHT_END_KERNELS
