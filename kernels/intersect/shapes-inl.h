// Stages over spheres, disks or planes: which records, which tree, how lanes are filled.
// `Shape` is one of the policies below.
#ifndef LANELIGHT_INTERSECT_SHAPES_INL_H_
#define LANELIGHT_INTERSECT_SHAPES_INL_H_

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/round-inl.h"
#include "kernels/intersect/uv.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

template <class D>
LANELIGHT_INLINE P3<hn::Vec<D>> Broadcast3(D d, const float p[3]) {
  return {hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])};
}
template <class D>
LANELIGHT_INLINE P3<hn::Vec<D>> Load3(D d, const float (*p)[kBvhWidth], int i) {
  return {hn::Load(d, p[0] + i), hn::Load(d, p[1] + i), hn::Load(d, p[2] + i)};
}

struct SphereShape {
  using Record = SphereRecord;
  using Block = SphereBlock;
  static const AlignedVector<Record>& Records(const Geometry& g) { return g.spheres; }
  static uint32_t FirstId(const Geometry& g) { return g.ranges.spheres; }
  static const Bvh& Tree(const Accel& a) { return a.spheres; }
  static const Block* Blocks(const Accel& a) { return a.sphere_blocks.data(); }
  static const float* Center(const Record& r) { return r.center; }
  template <class D>
  static LANELIGHT_INLINE SphereLanes<hn::Vec<D>> Broadcast(D d, const Record& r) {
    return {Broadcast3(d, r.center), hn::Set(d, r.radius)};
  }
  static LANELIGHT_INLINE SphereLanes<V8> Load(const Block& b, int i) {
    return {Load3(D8(), b.center, i), hn::Load(D8(), b.radius + i)};
  }
};

struct DiskShape {
  using Record = DiskRecord;
  using Block = DiskBlock;
  static const AlignedVector<Record>& Records(const Geometry& g) { return g.disks; }
  static uint32_t FirstId(const Geometry& g) { return g.ranges.disks; }
  static const Bvh& Tree(const Accel& a) { return a.disks; }
  static const Block* Blocks(const Accel& a) { return a.disk_blocks.data(); }
  static const float* Center(const Record& r) { return r.center; }
  template <class D>
  static LANELIGHT_INLINE DiskLanes<hn::Vec<D>> Broadcast(D d, const Record& r) {
    return {Broadcast3(d, r.center), Broadcast3(d, r.normal), hn::Set(d, r.radius),
            hn::Set(d, r.inner_radius)};
  }
  static LANELIGHT_INLINE DiskLanes<V8> Load(const Block& b, int i) {
    const D8 d;
    return {Load3(d, b.center, i), Load3(d, b.normal, i), hn::Load(d, b.radius + i),
            hn::Load(d, b.inner_radius + i)};
  }
};

struct PlaneShape {
  using Record = PlaneRecord;
  static const AlignedVector<Record>& Records(const Geometry& g) { return g.planes; }
  static uint32_t FirstId(const Geometry& g) { return g.ranges.planes; }
  static const float* Center(const Record& r) { return r.point; }
  template <class D>
  static LANELIGHT_INLINE PlaneLanes<hn::Vec<D>> Broadcast(D d, const Record& r) {
    return {Broadcast3(d, r.point), Broadcast3(d, r.normal)};
  }
};
struct LargeSphereShape {
  using Record = LargeSphereRecord;
  static const AlignedVector<Record>& Records(const Geometry& g) {
    return g.large_spheres;
  }
  static uint32_t FirstId(const Geometry& g) { return g.ranges.large_spheres; }
  static const float* Center(const Record& r) { return r.point; }
  template <class D>
  static LANELIGHT_INLINE LargeSphereLanes<hn::Vec<D>> Broadcast(D d, const Record& r) {
    return {Broadcast3(d, r.point), Broadcast3(d, r.normal), hn::Set(d, r.curvature)};
  }
};
template <class Shape>
inline constexpr bool kHasTree = true;
template <>
inline constexpr bool kHasTree<PlaneShape> = false;
template <>
inline constexpr bool kHasTree<LargeSphereShape> = false;

/// A hit on a record: its number, the distance, and whether it is on the far side.
struct ShapePlace {
  uint32_t index;
  float t;
  bool far;
};

/// Returns whether a candidate of one ray counts; the far side of a sphere is decided
/// apart from the near one.
template <class Shape>
inline bool ShapePassesAlpha(const SceneParts& scene, const float o[3], const float d[3],
                             const ShapePlace& place) {
  const auto [index, t, far] = place;
  const auto& record = Shape::Records(*scene.geometry)[index];
  if (!(record.flags & kAlphaTested)) return true;
  double p[3];
  for (int i = 0; i < 3; ++i) {
    p[i] = double{o[i]} + double{t} * d[i] - Shape::Center(record)[i];
  }
  const SurfaceUv uv = UvOf(record, p);
  const uint32_t prim = Shape::FirstId(*scene.geometry) + index;
  const float alpha = AlphaAt(scene, prim, uv.u, uv.v, [&]() HWY_ATTR {
    PointOfAlpha at;
    NormalOf(record, p, at.n);
    for (int i = 0; i < 3; ++i)
      at.p[i] = static_cast<float>(Shape::Center(record)[i] + p[i]);
    return at;
  });
  return AlphaHash(o, d, far ? ~prim : prim) < alpha;
}

/// Drops the candidates of one record that are cut out.
template <class Shape>
LANELIGHT_INLINE void CutOutShape(const SceneParts& scene, const Rays& rays,
                                  uint32_t index, Candidates<VF, MF>& hit) {
  const DF df;
  if (!(Shape::Records(*scene.geometry)[index].flags & kAlphaTested)) return;
  const RayArrays ray(rays, hn::Zero(DI()));
  const auto kept = [&](MF mask, VF t_lanes, bool far) HWY_ATTR {
    HWY_ALIGN float t[hn::MaxLanes(DF())];
    hn::Store(t_lanes, df, t);
    uint32_t pass = 0;
    for (uint32_t bits = MaskBits(df, mask); bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      const float o[3] = {ray.o[0][i], ray.o[1][i], ray.o[2][i]};
      const float d[3] = {ray.d[0][i], ray.d[1][i], ray.d[2][i]};
      if (ShapePassesAlpha<Shape>(scene, o, d, {index, t[i], far})) pass |= 1u << i;
    }
    return MaskOf(DF(), pass);
  };
  hit.near = kept(hit.near, hit.t_near, false);
  hit.far = kept(hit.far, hit.t_far, true);
}

/// The nearest candidate of each lane: its distance, and the lanes that have one.
template <class D, class V, class M>
LANELIGHT_INLINE M Nearest(D, const Candidates<V, M>& hit, V& t) {
  t = hn::IfThenElse(hit.near, hit.t_near, hit.t_far);
  return hn::Or(hit.near, hit.far);
}

// ---- A vector of rays against each record ------------------------------------------

template <class Shape, bool kAlpha, class Found>
LANELIGHT_INLINE void ForEachRecord(const SceneParts& scene, const Rays& rays,
                                    Found&& found) {
  const DF df;
  const auto& records = Shape::Records(*scene.geometry);
  const RayLanes<VF> ray{{rays.o.x, rays.o.y, rays.o.z}, {rays.d.x, rays.d.y, rays.d.z}};
  for (uint32_t i = 0; i < records.size(); ++i) {
    Candidates<VF, MF> hit = TestShape(df, Shape::Broadcast(df, records[i]), ray);
    if constexpr (kAlpha) CutOutShape<Shape>(scene, rays, i, hit);
    VF t;
    const MF mask = Nearest(df, hit, t);
    found(mask, t, Shape::FirstId(*scene.geometry) + i);
  }
}

template <class Shape, bool kAlpha, bool kInstances>
LANELIGHT_INLINE void IntersectRecords(Wave& wave) {
  const DI di;
  const PathColumns& path = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kActive), [&](const Slots& slots, MF) HWY_ATTR {
    const Rays rays = LoadRays(path, slots);
    VF best_t = rays.t_max;
    VI best_prim = Gather(path.prim, slots);
    MF any = hn::FirstN(DF(), 0);
    ForEachRecord<Shape, kAlpha>(wave, rays, [&](MF mask, VF t, uint32_t id) HWY_ATTR {
      const VI prim = hn::Set(di, static_cast<int32_t>(id));
      const MF closer = hn::And(mask, IsCloser(t, prim, best_t, best_prim));
      any = hn::Or(any, closer);
      best_t = hn::IfThenElse(closer, t, best_t);
      best_prim = hn::IfThenElse(hn::RebindMask(di, closer), prim, best_prim);
    });
    StoreRoundHits<kInstances>(path, slots, any, best_t, best_prim);
  });
}

template <class Shape, bool kAlpha>
LANELIGHT_INLINE void ShadowRecords(Wave& wave) {
  RemoveOccluded(wave, [&](const Rays& rays, VI, MF) HWY_ATTR {
    MF blocked = hn::FirstN(DF(), 0);
    ForEachRecord<Shape, kAlpha>(wave, rays, [&](MF mask, VF t, uint32_t) HWY_ATTR {
      blocked = hn::Or(blocked, hn::And(mask, hn::Lt(t, rays.t_max)));
    });
    return blocked;
  });
}

// ---- One ray against a tree --------------------------------------------------------

struct RoundHit {
  float t;
  uint32_t prim;
  bool found = false;
};

template <class Shape, bool kAny, bool kAlpha>
LANELIGHT_INLINE void TraceShapes(const SceneParts& scene, const float o[3],
                                  const float d[3], RoundHit& best) {
  const D8 d8;
  const uint32_t first = Shape::FirstId(*scene.geometry);
  const RayLanes<V8> ray{Broadcast3(d8, o), Broadcast3(d8, d)};
  const auto consider = [&](float t, uint32_t prim, bool far) HWY_ATTR {
    if (kAny ? t >= best.t : t > best.t || (t == best.t && prim >= best.prim)) return;
    if (kAlpha && !ShapePassesAlpha<Shape>(scene, o, d, {prim - first, t, far})) return;
    best.found = true;
    if (kAny) return;
    best.t = t;
    best.prim = prim;
  };
  const auto leaf = [&](uint32_t index) HWY_ATTR {
    const auto& block = Shape::Blocks(*scene.accel)[index];
    for (int i = 0; i < kBvhWidth; i += Lanes8()) {
      const Candidates<V8, M8> hit = TestShape(d8, Shape::Load(block, i), ray);
      HWY_ALIGN float near[kBvhWidth], far[kBvhWidth];
      hn::Store(hit.t_near, d8, near);
      hn::Store(hit.t_far, d8, far);
      for (uint32_t m = MaskBits(d8, hit.near); m != 0; m &= m - 1) {
        const int k = std::countr_zero(m);
        consider(near[k], block.prim[i + k], false);
      }
      for (uint32_t m = MaskBits(d8, hit.far); m != 0; m &= m - 1) {
        const int k = std::countr_zero(m);
        consider(far[k], block.prim[i + k], true);
      }
    }
    return kAny && best.found;
  };
  const Bvh& tree = Shape::Tree(*scene.accel);
  Traverse(scene.accel->nodes.data(), tree.root, MakeSlabRay(o, d, tree), best.t, leaf);
}

template <class Shape, bool kAlpha, bool kInstances>
LANELIGHT_INLINE void IntersectTree(Wave& wave) {
  const PathColumns& path = wave.path;
  // Written out: by a function for each ray the loop takes 1.7 times as long.
  ForEachBatch(wave, wave.queue(QueueId::kActive),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 const RayArrays rays(LoadRays(path, slots), slots);
                 const int count = static_cast<int>(hn::CountTrue(DF(), valid));
                 for (int i = 0; i < count; ++i) {
                   const uint32_t slot = rays.slot[i];
                   const float o[3] = {rays.o[0][i], rays.o[1][i], rays.o[2][i]};
                   const float d[3] = {rays.d[0][i], rays.d[1][i], rays.d[2][i]};
                   RoundHit hit{rays.t_max[i], path.prim[slot]};
                   TraceShapes<Shape, false, kAlpha>(wave, o, d, hit);
                   if (!hit.found) continue;
                   path.t[slot] = hit.t;
                   path.prim[slot] = hit.prim;
                   if constexpr (kInstances) path.inst[slot] = kWorldInstance;
                 }
               });
}

template <class Shape, bool kAlpha>
LANELIGHT_INLINE void ShadowTree(Wave& wave) {
  RemoveOccluded(wave, [&](const Rays& batch, VI slots, MF valid) HWY_ATTR {
    uint32_t blocked = 0;
    const RayArrays rays(batch, slots);
    const int count = static_cast<int>(hn::CountTrue(DF(), valid));
    for (int i = 0; i < count; ++i) {
      const float o[3] = {rays.o[0][i], rays.o[1][i], rays.o[2][i]};
      const float d[3] = {rays.d[0][i], rays.d[1][i], rays.d[2][i]};
      RoundHit hit{rays.t_max[i], 0};
      TraceShapes<Shape, true, kAlpha>(wave, o, d, hit);
      blocked |= uint32_t{hit.found} << i;
    }
    return MaskOf(DF(), blocked);
  });
}

template <class Shape, bool kAlpha, bool kInstances>
LANELIGHT_INLINE void IntersectShapes(Wave& wave) {
  if constexpr (kHasTree<Shape>) {
    if (Shape::Tree(*wave.accel).root != kEmptyRef) {
      return IntersectTree<Shape, kAlpha, kInstances>(wave);
    }
  }
  IntersectRecords<Shape, kAlpha, kInstances>(wave);
}

template <class Shape, bool kAlpha>
LANELIGHT_INLINE void ShadowShapes(Wave& wave) {
  if constexpr (kHasTree<Shape>) {
    if (Shape::Tree(*wave.accel).root != kEmptyRef) {
      return ShadowTree<Shape, kAlpha>(wave);
    }
  }
  ShadowRecords<Shape, kAlpha>(wave);
}

LANELIGHT_END_KERNELS

#endif
