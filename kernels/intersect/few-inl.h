// A vector of rays against every triangle of a small scene. Vertices shared by triangles
// are transformed once per vector of rays.
#if defined(LANELIGHT_INTERSECT_FEW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_FEW_INL_H_
#undef LANELIGHT_INTERSECT_FEW_INL_H_
#else
#define LANELIGHT_INTERSECT_FEW_INL_H_
#endif

#include "kernels/intersect/alpha-inl.h"
#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Lane-wise choice of the axis along which the direction is largest: x unless |y| is
/// larger, z if |z| is larger than both (as LargestAxis for one ray).
struct AxisOrder {
  MF y, z;

  HWY_INLINE explicit AxisOrder(V3 d) {
    const VF ax = hn::Abs(d.x), ay = hn::Abs(d.y), az = hn::Abs(d.z);
    y = hn::Gt(ay, ax);
    z = hn::Gt(az, hn::Max(ax, ay));
  }
  /// Cyclic permutation that brings the largest axis last.
  HWY_INLINE P3<VF> Permute(V3 v) const {
    return {hn::IfThenElse(z, v.x, hn::IfThenElse(y, v.z, v.y)),
            hn::IfThenElse(z, v.y, hn::IfThenElse(y, v.x, v.z)),
            hn::IfThenElse(z, v.z, hn::IfThenElse(y, v.y, v.x))};
  }
};

HWY_INLINE Shear<VF> MakeShear(const AxisOrder& order, const Rays& rays, float reach) {
  Shear<VF> shear;
  shear.o = order.Permute(rays.o);
  const P3<VF> d = order.Permute(rays.d);
  shear.s = {hn::Div(d.x, d.z), hn::Div(d.y, d.z), hn::Div(Splat(1.0f), d.z)};
  shear.abs_dz = hn::Abs(d.z);
  const VF r =
      hn::Add(Splat(reach),
              MaxComponent({hn::Abs(rays.o.x), hn::Abs(rays.o.y), hn::Abs(rays.o.z)}));
  shear.t_scale =
      hn::Div(hn::Mul(hn::Mul(hn::Mul(Splat(0x1p-13f), r), r), r), shear.abs_dz);
  return shear;
}

/// Distinct vertices of the scene, sheared for the rays of one batch.
class FewVertices {
 public:
  HWY_INLINE FewVertices(const FewTriangles& few, const AxisOrder& order,
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
  HWY_INLINE P3<VF> operator[](uint32_t i) const {
    const DF df;
    const float* at = data_ + 3 * kLanes * i;
    return {hn::Load(df, at), hn::Load(df, at + kLanes), hn::Load(df, at + 2 * kLanes)};
  }

 private:
  static constexpr size_t kLanes = hn::MaxLanes(DF());
  HWY_ALIGN float data_[3 * kFewTriangles * 3 * kLanes];
};

/// Clears the lanes of `mask` whose candidate hit on `prim` is cut out.
HWY_INLINE MF CutOut(const CompiledScene& scene, const Rays& rays, uint32_t prim,
                     const TriangleHits<VF, MF>& hit, MF mask) {
  const DF df;
  if (!(scene.geometry.triangles[prim].flags & kAlphaTested)) return mask;
  const RayArrays ray(rays, hn::Zero(DI()));
  HWY_ALIGN float b1[hn::MaxLanes(DF())], b2[hn::MaxLanes(DF())];
  hn::Store(hn::Div(hit.v, hit.det), df, b1);
  hn::Store(hn::Div(hit.w, hit.det), df, b2);
  uint32_t kept = 0;
  for (uint32_t bits = MaskBits(df, mask); bits != 0; bits &= bits - 1) {
    const int i = std::countr_zero(bits);
    const float o[3] = {ray.o[0][i], ray.o[1][i], ray.o[2][i]};
    const float d[3] = {ray.d[0][i], ray.d[1][i], ray.d[2][i]};
    if (TrianglePassesAlpha(scene, o, d, prim, b1[i], b2[i])) kept |= 1u << i;
  }
  return MaskFromBits(kept);
}

/// Calls found(hits, mask, prim) for every triangle that some lane hits within its t_max
/// as `t_max()` says at that time; stops when found returns true.
template <bool kAlpha, class TMax, class Found>
HWY_INLINE void ForEachFew(const CompiledScene& scene, const Rays& rays, TMax&& t_max,
                           Found&& found) {
  const DF df;
  const FewTriangles& few = scene.accel.few;
  const AxisOrder order(rays.d);
  const Shear<VF> shear = MakeShear(order, rays, few.reach);
  const FewVertices vertices(few, order, shear);
  for (const FewTriangles::Triangle& triangle : few.triangles) {
    const auto is_ahead = [&](int lane) HWY_ATTR {
      const RayArrays ray(rays, hn::Zero(DI()));
      const float o[3] = {ray.o[0][lane], ray.o[1][lane], ray.o[2][lane]};
      const float d[3] = {ray.d[0][lane], ray.d[1][lane], ray.d[2][lane]};
      const auto& p = scene.geometry.triangles[triangle.prim].p;
      return PlaneIsAhead(o, d, p[0], p[1], p[2]);
    };
    const TriangleHits<VF, MF> hit = TestTriangle(
        df, shear, vertices[triangle.vertex[0]], vertices[triangle.vertex[1]],
        vertices[triangle.vertex[2]], t_max(), is_ahead);
    if (hn::AllFalse(df, hit.mask)) continue;
    MF mask = hit.mask;
    if constexpr (kAlpha) mask = CutOut(scene, rays, triangle.prim, hit, mask);
    if (found(hit, mask, triangle.prim)) return;
  }
}

template <bool kAlpha>
HWY_INLINE void IntersectFew(Wave& wave) {
  const DF df;
  const DI di;
  const PathColumns& path = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kActive), [&](VI slots, MF) HWY_ATTR {
    const Rays rays = LoadRays(path, slots);
    VF t = rays.t_max, v = hn::Zero(df), w = v, det = Splat(1.0f);
    VI prim = Gather(path.prim, slots);
    MF any = hn::FirstN(df, 0);
    ForEachFew<kAlpha>(
        *wave.scene, rays, [&]() HWY_ATTR { return t; },
        [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t id) HWY_ATTR {
          const VI id_v = hn::Set(di, static_cast<int32_t>(id));
          const MF closer = hn::And(mask, IsCloser(hit.t, id_v, t, prim));
          any = hn::Or(any, closer);
          t = hn::IfThenElse(closer, hit.t, t);
          prim = hn::IfThenElse(hn::RebindMask(di, closer), id_v, prim);
          v = hn::IfThenElse(closer, hit.v, v);
          w = hn::IfThenElse(closer, hit.w, w);
          det = hn::IfThenElse(closer, hit.det, det);
          return false;
        });
    Scatter(t, path.t, slots);
    Scatter(prim, path.prim, slots);
    const VF b1 = hn::Div(v, det), b2 = hn::Div(w, det);
    Scatter(hn::IfThenElse(any, b1, Gather(path.b1, slots)), path.b1, slots);
    Scatter(hn::IfThenElse(any, b2, Gather(path.b2, slots)), path.b2, slots);
  });
}

template <bool kAlpha>
HWY_INLINE void ShadowFew(Wave& wave) {
  const DF df;
  RemoveOccluded(wave, [&](const Rays& rays, VI, MF valid) HWY_ATTR {
    MF blocked = hn::FirstN(df, 0);
    ForEachFew<kAlpha>(
        *wave.scene, rays, [&]() HWY_ATTR { return rays.t_max; },
        [&](const TriangleHits<VF, MF>& hit, MF mask, uint32_t) HWY_ATTR {
          blocked = hn::Or(blocked, hn::And(mask, hn::Lt(hit.t, rays.t_max)));
          return hn::AllTrue(df, hn::Or(blocked, hn::Not(valid)));
        });
    return blocked;
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
