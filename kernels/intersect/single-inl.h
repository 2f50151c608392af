// One ray against the triangles of the world and of instances.
#if defined(LANELIGHT_INTERSECT_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_SINGLE_INL_H_
#undef LANELIGHT_INTERSECT_SINGLE_INL_H_
#else
#define LANELIGHT_INTERSECT_SINGLE_INL_H_
#endif

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/triangle-inl.h"
#include "src/compiled/scene.h"

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
LANELIGHT_INLINE int LargestAxis(const float d[3]) {
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
  LANELIGHT_INLINE GroupQuery(const OneRay& ray, const float o[3], const float d[3],
                              const Bvh& bvh, uint32_t inst, OneHit& hit)
      : ray_(ray), o_(o), d_(d), bvh_(bvh), inst_(inst), hit_(hit) {
    const uint32_t z = static_cast<uint32_t>(LargestAxis(d));
    const uint32_t x = z == 2 ? 0 : z + 1, y = x == 2 ? 0 : x + 1;
    leaf_ray_[0] = {{o[x], o[y], o[z]},
                    {d[x] / d[z], d[y] / d[z], 1 / d[z]},
                    {kLeafRow * x, kLeafRow * y, kLeafRow * z},
                    kNoPrimitive};  // a triangle may be in several instances
  }

  LANELIGHT_INLINE void Run() {
    Traverse(ray_.scene->accel.nodes.data(), bvh_.root, MakeSlabRay(o_, d_, bvh_), hit_.t,
             [this](uint32_t ref) HWY_ATTR {
               const TriangleBlock& block =
                   ray_.scene->accel.triangle_blocks[ref & kRefIndex];
               return ref & kSeparateBit ? Test(block.separate) : Test(block.shared);
             });
  }

 private:
  // Tests the triangles of a leaf; true if the query is over.
  template <class Leaf>
  LANELIGHT_INLINE bool Test(const Leaf& leaf) {
    LeafWeights weights;
    const Leaf* leaves[1] = {&leaf};
    LeafWeights* to[1] = {&weights};
    uint32_t hits[1];
    TestLeaves(leaf_ray_, leaves, to, hits);
    const auto copy_ray = [&](float o[3], float d[3]) HWY_ATTR {
      for (int a = 0; a < 3; ++a) o[a] = o_[a], d[a] = d_[a];
    };
    for (uint32_t bits = hits[0]; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(bits));
      float t, det;
      if (!FinishLane(leaf, weights, i, copy_ray, t, det)) continue;
      if (!IsCloser(t, leaf.prim[i])) continue;
      const float b1 = weights.v[i] / det, b2 = weights.w[i] / det;
      if constexpr (kAlpha) {
        if (!TrianglePassesAlpha(*ray_.scene, ray_.o, ray_.d, leaf.prim[i], b1, b2)) {
          continue;
        }
      }
      hit_.found = true;
      if constexpr (kAny) return true;
      hit_ = {t, leaf.prim[i], b1, b2, inst_, true};
    }
    return false;
  }

  // Ties go to the smaller primitive, then to the smaller instance.
  LANELIGHT_INLINE bool IsCloser(float t, uint32_t prim) const {
    if (t != hit_.t || kAny) return t < hit_.t;
    return prim != hit_.prim ? prim < hit_.prim : inst_ < hit_.inst;
  }

  const OneRay& ray_;
  const float* o_;
  const float* d_;
  const Bvh& bvh_;
  uint32_t inst_;
  OneHit& hit_;
  LeafRay leaf_ray_[1];
};

/// Ray through a 3x4 map: points with w = 1, directions with w = 0.
LANELIGHT_INLINE void MapRay(const float m[12], const float p[3], float w,
                             float result[3]) {
  for (int r = 0; r < 3; ++r) {
    const float* row = m + 4 * r;
    result[r] = row[0] * p[0] + row[1] * p[1] + (row[2] * p[2] + row[3] * w);
  }
}

/// The whole query of one ray.
template <bool kAny, bool kAlpha>
LANELIGHT_INLINE void TraceTriangles(const OneRay& ray, OneHit& hit) {
  const Accel& accel = ray.scene->accel;
  GroupQuery<kAny, kAlpha>(ray, ray.o, ray.d, accel.groups[0], kWorldInstance, hit).Run();
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

/// Closest hits of a batch, ray by ray; hits are written to the columns.
template <bool kAlpha>
LANELIGHT_INLINE void ClosestSingle(const Wave& wave, const Rays& batch, VI slots,
                                    int count) {
  const PathColumns& path = wave.path;
  const RayArrays rays(batch, slots);
  for (int i = 0; i < count; ++i) {
    const uint32_t slot = rays.slot[i];
    const OneRay ray{wave.scene,
                     {rays.o[0][i], rays.o[1][i], rays.o[2][i]},
                     {rays.d[0][i], rays.d[1][i], rays.d[2][i]}};
    OneHit hit{rays.t_max[i], path.prim[slot], 0, 0, kWorldInstance};
    TraceTriangles<false, kAlpha>(ray, hit);
    if (!hit.found) continue;
    path.t[slot] = hit.t;
    path.prim[slot] = hit.prim;
    path.b1[slot] = hit.b1;
    path.b2[slot] = hit.b2;
    path.inst[slot] = hit.inst;
  }
}

/// Which rays of a batch are blocked.
template <bool kAlpha>
LANELIGHT_INLINE MF BlockedSingle(const CompiledScene& scene, const Rays& batch, VI slots,
                                  int count) {
  const RayArrays rays(batch, slots);
  uint32_t blocked = 0;
  for (int i = 0; i < count; ++i) {
    const OneRay ray{&scene,
                     {rays.o[0][i], rays.o[1][i], rays.o[2][i]},
                     {rays.d[0][i], rays.d[1][i], rays.d[2][i]}};
    OneHit hit{rays.t_max[i], 0, 0, 0, kWorldInstance};
    TraceTriangles<true, kAlpha>(ray, hit);
    blocked |= uint32_t{hit.found} << i;
  }
  return MaskOf(DF(), blocked);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
