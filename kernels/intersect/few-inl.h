// A vector of rays against every triangle of a small scene. Vertices shared by triangles
// are transformed once per vector of rays.
#ifndef LANELIGHT_INTERSECT_FEW_INL_H_
#define LANELIGHT_INTERSECT_FEW_INL_H_

#include "kernels/intersect/many-inl.h"
#include "src/scene/geometry/accel.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// Distinct vertices of the scene, sheared for the rays of one batch.
class FewVertices {
 public:
  LANELIGHT_INLINE FewVertices(const FewTriangles& few, const AxisOrder& order,
                               const Shear<VF>& shear) {
    const DF df;
    float* to = data_;
    for (const Vec3f& v : few.vertices) {
      const P3<VF> p = ShearVertex(df, shear, order.Permute(Splat3(v.x, v.y, v.z)));
      hn::Store(p.x, df, to);
      hn::Store(p.y, df, to + kLanes);
      hn::Store(p.z, df, to + 2 * kLanes);
      to += 3 * kLanes;
    }
  }
  LANELIGHT_INLINE P3<VF> operator[](uint32_t i) const {
    const DF df;
    const float* at = data_ + 3 * kLanes * i;
    return {hn::Load(df, at), hn::Load(df, at + kLanes), hn::Load(df, at + 2 * kLanes)};
  }

 private:
  static constexpr size_t kLanes = hn::MaxLanes(DF());
  HWY_ALIGN float data_[3 * kFewTriangles * 3 * kLanes];
};

/// Calls found(hits, mask, prim) for every triangle that some lane hits within its t_max
/// as `t_max()` says at that time; stops when found returns true.
template <bool kAlpha, class TMax, class Found>
LANELIGHT_INLINE void ForEachFew(const SceneParts& scene, const Rays& rays, TMax&& t_max,
                                 Found&& found) {
  const DF df;
  const FewTriangles& few = scene.accel->few;
  const AxisOrder order(rays.d);
  const Shear<VF> shear = MakeShear(order, rays, Splat(few.reach));
  const FewVertices vertices(few, order, shear);
  for (const FewTriangles::Triangle& triangle : few.triangles) {
    const uint32_t* v = triangle.vertex;
    const auto is_ahead = [&](MF) HWY_ATTR {
      return AheadOf(rays, &few.vertices[v[0]].x, &few.vertices[v[1]].x,
                     &few.vertices[v[2]].x);
    };
    const TriangleHits<VF, MF> hit =
        TestTriangle(shear, {vertices[v[0]], vertices[v[1]], vertices[v[2]]}, t_max(),
                     ExcludesStart(rays, triangle.prim), is_ahead);
    if (hn::AllFalse(df, hit.mask)) continue;
    MF mask = hit.mask;
    if constexpr (kAlpha) mask = CutOut(scene, rays, triangle.prim, hit, mask);
    if (found(hit, mask, triangle.prim)) return;
  }
}

/// Finds the closest hits of a batch and writes them to the columns.
template <bool kAlpha>
LANELIGHT_INLINE void ClosestFew(const Wave& wave, const Rays& rays, const Slots& slots) {
  PacketBest best = NoHits(rays.t_max, Gather(wave.path.prim, slots));
  ForEachFew<kAlpha>(
      wave, rays, [&]() HWY_ATTR { return best.t; },
      [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t id) HWY_ATTR {
        best.AcceptNearer(hit, mask, id);
        return false;
      });
  best.Store(wave.path, slots);
}

/// Returns the rays of a batch that are blocked.
template <bool kAlpha>
LANELIGHT_INLINE MF BlockedFew(const SceneParts& scene, const Rays& rays) {
  const DF df;
  MF blocked = hn::FirstN(df, 0);
  ForEachFew<kAlpha>(
      scene, rays, [&]() HWY_ATTR { return rays.t_max; },
      [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t) HWY_ATTR {
        blocked = hn::Or(blocked, hn::And(mask, hn::Lt(hit.t, rays.t_max)));
        return hn::AllTrue(df, blocked);
      });
  return blocked;
}

LANELIGHT_END_KERNELS

#endif
