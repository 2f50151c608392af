// Tests of spheres, disks and planes, for any arrangement of lanes (many rays against one
// shape, or one ray against many shapes), with the same arithmetic in both.
//
// A shape offers up to two candidates, near and far, since alpha may drop the near one.
// If the origin lies within rounding error of the shape, the sign of the distance is
// decided in double precision. Surface points therefore move by the rounding of their own
// coordinates only.
#ifndef LANELIGHT_INTERSECT_ROUND_INL_H_
#define LANELIGHT_INTERSECT_ROUND_INL_H_

#include <cfloat>

#include "kernels/intersect/rays-inl.h"
#include "kernels/intersect/triangle-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class V>
struct RayLanes {
  P3<V> o, d;
};

template <class V>
LANELIGHT_INLINE V Dot(P3<V> a, P3<V> b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class V>
LANELIGHT_INLINE P3<V> Sub(P3<V> a, P3<V> b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// a + b * s
template <class V>
LANELIGHT_INLINE P3<V> AddScaled(P3<V> a, P3<V> b, V s) {
  return {hn::MulAdd(b.x, s, a.x), hn::MulAdd(b.y, s, a.y), hn::MulAdd(b.z, s, a.z)};
}

/// Distances at which a shape is met, where `near` and `far` say so; t_near <= t_far.
template <class V, class M>
struct Candidates {
  M near, far;
  V t_near, t_far;
};

/// The candidates among two roots: those in (0, FLT_MAX]. Divisions by zero give others.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE Candidates<V, M> FromRoots(D df, M meets, V t0, V t1) {
  const V zero = hn::Zero(df), largest = hn::Set(df, FLT_MAX);
  const V near = hn::Min(t0, t1), far = hn::Max(t0, t1);
  return {hn::And(meets, hn::And(hn::Gt(near, zero), hn::Le(near, largest))),
          hn::And(meets, hn::And(hn::Gt(far, zero), hn::Le(far, largest))), near, far};
}

template <class V>
struct SphereLanes {
  P3<V> center;
  V radius;
};

/// Roots of |o + t d - center| = radius without cancellation: the discriminant from the
/// point of closest approach (Haines, Günther and Akenine-Möller 2019, "Precision
/// Improvements for Ray/Sphere Intersection"), the roots as c / q and q / a. Their
/// positions are within 8u (|coordinates| + |o|) of the sphere, u = 2^-24.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE Candidates<V, M> TestShape(D df, const SphereLanes<V>& s,
                                            const RayLanes<V>& ray) {
  const V zero = hn::Zero(df);
  const P3<V> f = Sub(ray.o, s.center);
  const V a = Dot(ray.d, ray.d), b = hn::Neg(Dot(f, ray.d));
  const V r2 = hn::Mul(s.radius, s.radius), f2 = Dot(f, f);
  const P3<V> closest = AddScaled(f, ray.d, hn::Div(b, a));
  const V discriminant = hn::Sub(r2, Dot(closest, closest));
  Candidates<V, M> hit;
  const M meets = hn::And(hn::Ge(discriminant, zero), hn::Gt(s.radius, zero));
  hit.near = hit.far = meets;
  hit.t_near = hit.t_far = zero;
  if (hn::AllFalse(df, meets)) return hit;
  V c = hn::Sub(f2, r2);
  const M uncertain =
      hn::And(meets, hn::Le(hn::Abs(c), hn::Mul(hn::Add(f2, r2), hn::Set(df, 0x1p-10f))));
  if (HWY_UNLIKELY(!hn::AllFalse(df, uncertain))) {
    const auto power = [](auto, auto ox, auto oy, auto oz, auto cx, auto cy, auto cz,
                          auto r) HWY_ATTR {
      const auto x = hn::Sub(ox, cx), y = hn::Sub(oy, cy), z = hn::Sub(oz, cz);
      const auto sum = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
      return hn::Sub(sum, hn::Mul(r, r));
    };
    const V exact = InDouble(df, power, ray.o.x, ray.o.y, ray.o.z, s.center.x, s.center.y,
                             s.center.z, s.radius);
    c = hn::IfThenElse(uncertain, exact, c);
  }
  const V root = hn::Sqrt(hn::Mul(a, discriminant));
  const V q = hn::Add(b, hn::CopySign(root, b));
  // A ray that touches at its closest point may divide by zero.
  return FromRoots(df, meets, hn::Div(c, q), hn::Div(q, a));
}

template <class V>
struct LargeSphereLanes {
  P3<V> point, normal;
  V curvature;
};

/// Roots of c + 2 b t + a t^2, which is twice the height over the sphere along the ray
/// (LargeSphereRecord in src/scene/geometry/geometry.h), with half of its gradient
/// g = normal + curvature q at the origin: nothing is as large as the radius, so nothing
/// cancels that is not small for all spheres.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE Candidates<V, M> TestShape(D df, const LargeSphereLanes<V>& s,
                                            const RayLanes<V>& ray) {
  const V zero = hn::Zero(df);
  const P3<V> q = Sub(ray.o, s.point);
  const P3<V> g = AddScaled(s.normal, q, s.curvature);
  const P3<V> sum = {hn::Add(s.normal.x, g.x), hn::Add(s.normal.y, g.y),
                     hn::Add(s.normal.z, g.z)};
  V c = Dot(q, sum);
  const V magnitude = hn::MulAdd(
      hn::Abs(q.x), hn::Abs(sum.x),
      hn::MulAdd(hn::Abs(q.y), hn::Abs(sum.y), hn::Mul(hn::Abs(q.z), hn::Abs(sum.z))));
  const auto uncertain = hn::Le(hn::Abs(c), hn::Mul(magnitude, hn::Set(df, 0x1p-10f)));
  if (HWY_UNLIKELY(!hn::AllFalse(df, uncertain))) {
    const auto height = [](auto, auto ox, auto oy, auto oz, auto px, auto py, auto pz,
                           auto nx, auto ny, auto nz, auto curvature) HWY_ATTR {
      const auto term = [&](auto o, auto p, auto n) HWY_ATTR {
        const auto d = hn::Sub(o, p);
        return hn::Mul(d, hn::Add(hn::Add(n, n), hn::Mul(curvature, d)));
      };
      return hn::Add(hn::Add(term(ox, px, nx), term(oy, py, ny)), term(oz, pz, nz));
    };
    const V exact = InDouble(df, height, ray.o.x, ray.o.y, ray.o.z, s.point.x, s.point.y,
                             s.point.z, s.normal.x, s.normal.y, s.normal.z, s.curvature);
    c = hn::IfThenElse(uncertain, exact, c);
  }
  const V a = hn::Mul(s.curvature, Dot(ray.d, ray.d)), b = Dot(g, ray.d);
  const V discriminant = hn::NegMulAdd(a, c, hn::Mul(b, b));
  const V root = hn::Sqrt(hn::Max(discriminant, zero));
  const V sum_b = hn::Neg(hn::Add(b, hn::CopySign(root, b)));
  return FromRoots(df, hn::Ge(discriminant, zero), hn::Div(c, sum_b), hn::Div(sum_b, a));
}

/// Distance to the plane through `point` with normal n; the sign is that of the exact
/// value for the given n. Infinite or NaN for a ray along the plane.
template <class D, class V = hn::Vec<D>>
LANELIGHT_INLINE V PlaneDistance(D df, P3<V> point, P3<V> n, const RayLanes<V>& ray) {
  const P3<V> f = Sub(point, ray.o);
  V height = Dot(n, f);
  const P3<V> abs_n = {hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)};
  const P3<V> abs_f = {hn::Abs(f.x), hn::Abs(f.y), hn::Abs(f.z)};
  const auto uncertain =
      hn::Le(hn::Abs(height), hn::Mul(Dot(abs_n, abs_f), hn::Set(df, 0x1p-10f)));
  if (HWY_UNLIKELY(!hn::AllFalse(df, uncertain))) {
    const auto dot = [](auto, auto px, auto py, auto pz, auto ox, auto oy, auto oz,
                        auto nx, auto ny, auto nz) HWY_ATTR {
      return hn::Add(hn::Add(hn::Mul(nx, hn::Sub(px, ox)), hn::Mul(ny, hn::Sub(py, oy))),
                     hn::Mul(nz, hn::Sub(pz, oz)));
    };
    const V exact = InDouble(df, dot, point.x, point.y, point.z, ray.o.x, ray.o.y,
                             ray.o.z, n.x, n.y, n.z);
    height = hn::IfThenElse(uncertain, exact, height);
  }
  return hn::Div(height, Dot(n, ray.d));
}

template <class V>
struct DiskLanes {
  P3<V> center, normal;
  V radius, inner_radius;
};

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE Candidates<V, M> TestShape(D df, const DiskLanes<V>& s,
                                            const RayLanes<V>& ray) {
  Candidates<V, M> hit;
  hit.t_near = hit.t_far = PlaneDistance(df, s.center, s.normal, ray);
  const P3<V> p = AddScaled(Sub(ray.o, s.center), ray.d, hit.t_near);
  const V distance2 = Dot(p, p);
  hit.near =
      hn::And(hn::And(hn::Gt(hit.t_near, hn::Zero(df)), hn::Gt(s.radius, hn::Zero(df))),
              hn::And(hn::Le(distance2, hn::Mul(s.radius, s.radius)),
                      hn::Ge(distance2, hn::Mul(s.inner_radius, s.inner_radius))));
  hit.far = hn::FirstN(df, 0);
  return hit;
}

template <class V>
struct PlaneLanes {
  P3<V> point, normal;
};

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE Candidates<V, M> TestShape(D df, const PlaneLanes<V>& s,
                                            const RayLanes<V>& ray) {
  Candidates<V, M> hit;
  hit.t_near = hit.t_far = PlaneDistance(df, s.point, s.normal, ray);
  hit.near =
      hn::And(hn::Gt(hit.t_near, hn::Zero(df)), hn::Le(hit.t_near, hn::Set(df, FLT_MAX)));
  hit.far = hn::FirstN(df, 0);
  return hit;
}

LANELIGHT_END_KERNELS

#endif
