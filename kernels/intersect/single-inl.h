// One ray against the triangle BVH, with or without instances.
#if defined(LANELIGHT_INTERSECT_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_SINGLE_INL_H_
#undef LANELIGHT_INTERSECT_SINGLE_INL_H_
#else
#define LANELIGHT_INTERSECT_SINGLE_INL_H_
#endif

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The hit of one ray so far. In a shadow query t is the exclusive end and stays.
struct OneHit {
  float t;
  uint32_t prim;
  float b1, b2;
  uint32_t inst;
  bool found = false;
};

/// Axis of the largest |component|; ties go to the first (as AxisOrder for many rays).
HWY_INLINE int LargestAxis(const float d[3]) {
  int axis = std::abs(d[1]) > std::abs(d[0]) ? 1 : 0;
  if (std::abs(d[2]) > std::abs(d[axis])) axis = 2;
  return axis;
}

/// What the query is about, and the ray in scene space (alpha decisions use it).
struct OneRay {
  const CompiledScene* scene;
  float o[3], d[3];
};

/// One ray against the triangles of one group, in its space.
template <bool kAny, bool kAlpha>
class GroupQuery {
 public:
  HWY_INLINE GroupQuery(const OneRay& ray, const float o[3], const float d[3],
                        const Bvh& bvh, uint32_t inst, OneHit& hit)
      : ray_(ray), o_(o), d_(d), bvh_(bvh), inst_(inst), hit_(hit) {
    const D8 d8;
    z_ = LargestAxis(d);
    x_ = z_ == 2 ? 0 : z_ + 1;
    y_ = x_ == 2 ? 0 : x_ + 1;
    shear_.o = {hn::Set(d8, o[x_]), hn::Set(d8, o[y_]), hn::Set(d8, o[z_])};
    shear_.s = {hn::Set(d8, d[x_] / d[z_]), hn::Set(d8, d[y_] / d[z_]),
                hn::Set(d8, 1 / d[z_])};
    const float abs_dz = std::abs(d[z_]);
    shear_.abs_dz = hn::Set(d8, abs_dz);
    shear_.t_scale = hn::Set(d8, SignBound(bvh.reach + LargestCoordinate(o), abs_dz));
  }

  HWY_INLINE void Run() {
    Traverse(ray_.scene->accel.nodes.data(), bvh_.root, MakeSlabRay(o_, d_, bvh_), hit_.t,
             [this](uint32_t block)
                 HWY_ATTR { return Test(ray_.scene->accel.triangle_blocks[block]); });
  }

 private:
  // Tests the triangles of a leaf; true if the query is over.
  HWY_INLINE bool Test(const TriangleBlock& block) {
    const D8 d8;
    for (int i = 0; i < kBvhWidth; i += Lanes8()) {
      const auto vertex = [&](int k) HWY_ATTR {
        return ShearVertex(
            d8, shear_,
            P3<V8>{hn::Load(d8, block.v[k][x_] + i), hn::Load(d8, block.v[k][y_] + i),
                   hn::Load(d8, block.v[k][z_] + i)});
      };
      const auto is_ahead = [&](M8 lanes) HWY_ATTR { return Ahead(block, i, lanes); };
      const TriangleHits<V8, M8> hit = TestTriangle(
          d8, shear_, vertex(0), vertex(1), vertex(2), hn::Set(d8, hit_.t), is_ahead);
      const uint32_t bits = MaskBits(d8, hit.mask);
      if (bits != 0 && Consider(block.prim + i, hit, bits)) return true;
    }
    return false;
  }

  // Lanes of the block from `first` whose plane lies ahead, among `lanes`.
  HWY_NOINLINE M8 Ahead(const TriangleBlock& block, int first, M8 lanes) const {
    const D8 d8;
    uint32_t ahead = 0;
    for (uint32_t bits = MaskBits(d8, lanes); bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      float p[3][3];
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) p[k][a] = block.v[k][a][first + lane];
      }
      double n[3];
      ExactNormal(p[0], p[1], p[2], n);
      if (PlaneIsAhead(o_, d_, n, p[0])) ahead |= 1u << lane;
    }
    return MaskOf(d8, ahead);
  }

  HWY_INLINE bool Consider(const uint32_t* prim, const TriangleHits<V8, M8>& hit,
                           uint32_t bits) {
    const D8 d8;
    HWY_ALIGN float t[kBvhWidth], b1[kBvhWidth], b2[kBvhWidth];
    hn::Store(hit.t, d8, t);
    hn::Store(hn::Div(hit.v, hit.det), d8, b1);
    hn::Store(hn::Div(hit.w, hit.det), d8, b2);
    for (; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      if (!IsCloser(t[i], prim[i])) continue;
      if constexpr (kAlpha) {
        if (!TrianglePassesAlpha(*ray_.scene, ray_.o, ray_.d, prim[i], b1[i], b2[i])) {
          continue;
        }
      }
      hit_.found = true;
      if constexpr (kAny) return true;
      hit_.t = t[i];
      hit_.prim = prim[i];
      hit_.b1 = b1[i];
      hit_.b2 = b2[i];
      hit_.inst = inst_;
    }
    return false;
  }

  // Ties go to the smaller primitive, then to the smaller instance.
  HWY_INLINE bool IsCloser(float t, uint32_t prim) const {
    if (t != hit_.t || kAny) return t < hit_.t;
    return prim != hit_.prim ? prim < hit_.prim : inst_ < hit_.inst;
  }

  const OneRay& ray_;
  const float* o_;
  const float* d_;
  const Bvh& bvh_;
  uint32_t inst_;
  OneHit& hit_;
  int x_, y_, z_;  // axes permuted so that |d[z_]| is largest
  Shear<V8> shear_;
};

/// Ray through a 3x4 map: points with w = 1, directions with w = 0.
HWY_INLINE void MapRay(const float m[12], const float p[3], float w, float result[3]) {
  for (int r = 0; r < 3; ++r) {
    const float* row = m + 4 * r;
    result[r] = row[0] * p[0] + row[1] * p[1] + (row[2] * p[2] + row[3] * w);
  }
}

/// The whole query of one ray.
template <bool kAny, bool kAlpha, bool kInstances>
HWY_INLINE void TraceTriangles(const OneRay& ray, OneHit& hit) {
  const Accel& accel = ray.scene->accel;
  GroupQuery<kAny, kAlpha>(ray, ray.o, ray.d, accel.groups[0], kWorldInstance, hit).Run();
  if constexpr (kInstances) {
    if (kAny && hit.found) return;
    const Geometry& geometry = ray.scene->geometry;
    Traverse(accel.nodes.data(), accel.top.root, MakeSlabRay(ray.o, ray.d, accel.top),
             hit.t, [&](uint32_t i) HWY_ATTR {
               float o[3], d[3];
               MapRay(geometry.instances[i].object_from_scene, ray.o, 1, o);
               MapRay(geometry.instances[i].object_from_scene, ray.d, 0, d);
               const Bvh& group = accel.groups[geometry.instance_group[i]];
               GroupQuery<kAny, kAlpha>(ray, o, d, group, i, hit).Run();
               return kAny && hit.found;
             });
  }
}

/// Closest hits of a batch, ray by ray; hits are written to the columns.
template <bool kAlpha, bool kInstances>
HWY_INLINE void ClosestSingle(const Wave& wave, const Rays& batch, VI slots, int count) {
  const PathColumns& path = wave.path;
  const RayArrays rays(batch, slots);
  for (int i = 0; i < count; ++i) {
    const uint32_t slot = rays.slot[i];
    const OneRay ray{wave.scene,
                     {rays.o[0][i], rays.o[1][i], rays.o[2][i]},
                     {rays.d[0][i], rays.d[1][i], rays.d[2][i]}};
    OneHit hit{rays.t_max[i], path.prim[slot], 0, 0, kWorldInstance};
    TraceTriangles<false, kAlpha, kInstances>(ray, hit);
    if (!hit.found) continue;
    path.t[slot] = hit.t;
    path.prim[slot] = hit.prim;
    path.b1[slot] = hit.b1;
    path.b2[slot] = hit.b2;
    if constexpr (kInstances) path.inst[slot] = hit.inst;
  }
}

/// Which rays of a batch are blocked.
template <bool kAlpha, bool kInstances>
HWY_INLINE MF BlockedSingle(const CompiledScene& scene, const Rays& batch, VI slots,
                            int count) {
  const RayArrays rays(batch, slots);
  uint32_t blocked = 0;
  for (int i = 0; i < count; ++i) {
    const OneRay ray{&scene,
                     {rays.o[0][i], rays.o[1][i], rays.o[2][i]},
                     {rays.d[0][i], rays.d[1][i], rays.d[2][i]}};
    OneHit hit{rays.t_max[i], 0, 0, 0, kWorldInstance};
    TraceTriangles<true, kAlpha, kInstances>(ray, hit);
    blocked |= uint32_t{hit.found} << i;
  }
  return MaskOf(DF(), blocked);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
