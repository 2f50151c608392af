// The triangle test for any arrangement of lanes: many rays against one triangle, or one
// ray against many. The arithmetic is the same in both, so a pair has one distance
// whatever the traversal.
//
// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Vertices are taken
// relative to the origin, axes are permuted so that |d_z| is largest, and sheared so that
// the ray is the z axis. Each vertex is transformed without its triangle, so neighbours
// see the same 2D points. A ray passes between two triangles only if an edge function has
// the wrong sign. Here edge functions have the sign of the exact a*b - c*d (below), so
// zero is no special case. The signs hold unless a product underflows: unless the ray
// passes within about 1e-19 of a vertex.
//
// Error bounds, u = 2^-24. R bounds |coordinates| of the vertices plus |o|.
//   relative vertices     u |A|
//   sheared A.x, A.y      7u R       (difference, S, product, sum)
//   edge functions        3u relative to their exact value on the sheared points
//   t = sum(U_i z_i) / sum(U_i)  12u R |Sz|: the U_i have one sign, so t is a mean of the
//                         z_i and nothing cancels but the z_i themselves
// Hence o + t d lies within 20u R of the triangle: what the boxes must be grown by.
#ifndef LANELIGHT_INTERSECT_TRIANGLE_INL_H_
#define LANELIGHT_INTERSECT_TRIANGLE_INL_H_

#include <cfloat>

#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

// The sign of a hit distance in double precision, for the rare rays that start within
// rounding error of a shape.

/// Computes n = (v1 - v0) x (v2 - v0).
inline void ExactNormal(const float v0[3], const float v1[3], const float v2[3],
                        double n[3]) {
  double e1[3], e2[3];
  for (int i = 0; i < 3; ++i) {
    e1[i] = double{v1[i]} - v0[i];
    e2[i] = double{v2[i]} - v0[i];
  }
  n[0] = e1[1] * e2[2] - e1[2] * e2[1];
  n[1] = e1[2] * e2[0] - e1[0] * e2[2];
  n[2] = e1[0] * e2[1] - e1[1] * e2[0];
}

/// Returns whether the plane through `v0` with normal n lies ahead of `o` along `d` (t >
/// 0). AheadOf in many-inl.h does the same for many rays, with the same order of
/// operations.
inline bool PlaneIsAhead(const float o[3], const float d[3], const double n[3],
                         const float v0[3]) {
  const double distance =
      (n[0] * (double{v0[0]} - o[0]) + n[1] * (double{v0[1]} - o[1])) +
      n[2] * (double{v0[2]} - o[2]);
  const double speed = (n[0] * d[0] + n[1] * d[1]) + n[2] * d[2];
  return (distance > 0 && speed > 0) || (distance < 0 && speed < 0);
}

/// Bits of a mask of at most 16 lanes.
template <class D, class M>
LANELIGHT_INLINE uint32_t MaskBits(D d, M mask) {
#if HWY_TARGET <= HWY_AVX3
  (void)d;
  return mask.raw;  // through memory (below) the store would not be forwarded to the load
#else
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return hn::MaxLanes(d) > 8 ? bytes[0] | (uint32_t{bytes[1]} << 8) : bytes[0];
#endif
}

/// Mask of at most 16 lanes from bits.
template <class D>
LANELIGHT_INLINE hn::Mask<D> MaskOf(D d, uint32_t bits) {
  const hn::RebindToUnsigned<D> du;
  const auto lane_bit = hn::Shl(hn::Set(du, 1), hn::Iota(du, 0));
  return hn::RebindMask(d, hn::Ne(hn::And(lane_bit, hn::Set(du, bits)), hn::Zero(du)));
}

/// Points in the permuted axes of a ray: x, y across it, z along it.
template <class V>
struct P3 {
  V x, y, z;
};

/// A ray prepared for the triangle test.
template <class V>
struct Shear {
  P3<V> o;    // origin, permuted
  P3<V> s;    // d.x / d.z, d.y / d.z, 1 / d.z, permuted
  V abs_dz;   // |d.z|
  V t_scale;  // |t det| above this has the right sign
};

/// The bound `t_scale` for coordinates up to `reach` (vertices plus origin). From the
/// errors above, the error of t det is below 170 u m_z (m_x + z) (m_y + z), with m the
/// largest |coordinates| of the sheared vertices, z = m_z |d.z|; m_x, m_y <= 2 R,
/// m_z <= R |Sz|: below 2^-13 R^3 |Sz|.
LANELIGHT_INLINE float SignBound(float reach, float abs_dz) {
  return 0x1p-13f * reach * reach * reach / abs_dz;
}

/// Vertex relative to the ray, sheared.
template <class D, class V>
LANELIGHT_INLINE P3<V> ShearVertex(D, const Shear<V>& ray, P3<V> v) {
  const V x = hn::Sub(v.x, ray.o.x), y = hn::Sub(v.y, ray.o.y), z = hn::Sub(v.z, ray.o.z);
  return {hn::NegMulAdd(ray.s.x, z, x), hn::NegMulAdd(ray.s.y, z, y),
          hn::Mul(ray.s.z, z)};
}

/// True if computing edge functions of triangles that miss is cheap.
inline constexpr bool kCheapEdges = HWY_NATIVE_FMA;

/// a*b - c*e with the sign of the exact value and a relative error below 3u: with fused
/// multiply-add by Kahan's method (error below 1.5 ulp: Jeannerod, Louvet and Muller
/// 2013), without it in double precision, where both products are exact.
template <class D, class V>
LANELIGHT_INLINE V EdgeFunction(D d, V a, V b, V c, V e) {
#if HWY_NATIVE_FMA
  (void)d;
  const V ce = hn::Mul(c, e);
  return hn::Add(hn::MulSub(a, b, ce), hn::NegMulAdd(c, e, ce));
#else
  return InDouble(
      d,
      [](auto, auto p, auto q, auto r, auto s)
          HWY_ATTR { return hn::Sub(hn::Mul(p, q), hn::Mul(r, s)); },
      a, b, c, e);
#endif
}

/// The vertices of sheared triangles.
template <class V>
struct Corners {
  P3<V> a, b, c;
};

/// Lanes that hit in (0, t_max], their distance, and the barycentric weights of vertices
/// 1 and 2 times det.
template <class V, class M>
struct TriangleHits {
  M mask;
  V t, v, w, det;
};

template <class V>
LANELIGHT_INLINE V Min3(V a, V b, V c) {
  return hn::Min(a, hn::Min(b, c));
}
template <class V>
LANELIGHT_INLINE V Max3(V a, V b, V c) {
  return hn::Max(a, hn::Max(b, c));
}

/// Lanes whose vertices lie on both sides of the origin along the ray. The z of vertices
/// have exact signs; if they agree so does the sign of t.
template <class D, class V>
LANELIGHT_INLINE hn::Mask<D> Straddles(D d, const Corners<V>& at) {
  const V zero = hn::Zero(d), a = at.a.z, b = at.b.z, c = at.c.z;
  return hn::And(hn::Le(Min3(a, b, c), zero), hn::Ge(Max3(a, b, c), zero));
}

/// Lanes of `mask` (which straddle) whose t is so close to zero that its sign may be
/// wrong.
template <class D, class V, class M>
LANELIGHT_INLINE M UncertainSign(D d, const Shear<V>& ray, const Corners<V>& at, V t_det,
                                 M mask) {
  const auto& [a, b, c] = at;
  const V mx = Max3(hn::Abs(a.x), hn::Abs(b.x), hn::Abs(c.x));
  const V my = Max3(hn::Abs(a.y), hn::Abs(b.y), hn::Abs(c.y));
  const V mz = Max3(hn::Abs(a.z), hn::Abs(b.z), hn::Abs(c.z));
  const V z = hn::Mul(mz, ray.abs_dz);
  const V bound = hn::Mul(hn::Mul(hn::Set(d, 170 * 0x1p-24f), mz),
                          hn::Mul(hn::Add(mx, z), hn::Add(my, z)));
  return hn::And(mask, hn::Le(hn::Abs(t_det), bound));
}

/// The part of the triangle test that is the same for all lanes: edge functions, and a
/// first bound on the distance. `u` is the weight of vertex 0 times det; `t_det` is the
/// distance times det, once TestDistance has found it.
template <class V, class M>
struct TriangleEdges {
  M mask;
  V u, v, w, det, abs_det, t_det;
};

/// Lanes whose edge functions have one sign.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE M HaveOneSign(D d, const P3<V>& edges) {
  const V zero = hn::Zero(d);
  return hn::Or(hn::Ge(Min3(edges.x, edges.y, edges.z), zero),
                hn::Le(Max3(edges.x, edges.y, edges.z), zero));
}

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE TriangleEdges<V, M> JoinEdges(D d, const P3<V>& edges) {
  const V u = edges.x, v = edges.y, w = edges.z;
  const V det = hn::Add(u, hn::Add(v, w)), abs_det = hn::Abs(det);
  const M mask = hn::And(HaveOneSign(d, edges), hn::Gt(abs_det, hn::Zero(d)));
  return {mask, u, v, w, det, abs_det, hn::Zero(d)};
}

template <class D, class V = hn::Vec<D>>
LANELIGHT_INLINE P3<V> EdgesOf(D d, const P3<V>& a, const P3<V>& b, const P3<V>& c) {
  return {EdgeFunction(d, c.x, b.y, c.y, b.x), EdgeFunction(d, a.x, c.y, a.y, c.x),
          EdgeFunction(d, b.x, a.y, b.y, a.x)};
}

template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE TriangleEdges<V, M> TestEdges(D d, const Corners<V>& at) {
  return JoinEdges(d, EdgesOf(d, at.a, at.b, at.c));
}

/// Lanes whose edge functions may have one sign: all that pass TestEdges, and few others.
/// Where exact ones are dear, because there is no fused multiply-add, most triangles are
/// refused by these. A product errs by 2^-24 of itself and so does the difference, so
/// that the sign of p - q is right if |p - q| > 2^-22 |p|.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE M MayPassEdges(D d, const P3<V>& a, const P3<V>& b, const P3<V>& c) {
  const V p = hn::Mul(c.x, b.y), q = hn::Mul(a.x, c.y), r = hn::Mul(b.x, a.y);
  const V u = hn::Sub(p, hn::Mul(c.y, b.x)), v = hn::Sub(q, hn::Mul(a.y, c.x)),
          w = hn::Sub(r, hn::Mul(b.y, a.x));
  const V slack = hn::Mul(Max3(hn::Abs(p), hn::Abs(q), hn::Abs(r)), hn::Set(d, 0x1p-21f));
  return hn::Or(hn::Ge(Min3(u, v, w), hn::Neg(slack)), hn::Le(Max3(u, v, w), slack));
}

/// Finds e.t_det, by the plane of the triangle, and keeps in e.mask only the lanes that
/// may hit before t_max. `t_max` only prunes: candidates with t = t_max remain.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
LANELIGHT_INLINE void TestDistance(D d, const Shear<V>& ray, const Corners<V>& at,
                                   V t_max, TriangleEdges<V, M>& e) {
  e.t_det = hn::MulAdd(e.u, at.a.z, hn::MulAdd(e.v, at.b.z, hn::Mul(e.w, at.c.z)));
  // |t_det| with the sign of t. The factor covers the rounding of product and quotient.
  const V signed_t = hn::Xor(e.t_det, hn::And(e.det, hn::Set(d, -0.0f)));
  const V limit = hn::Mul(hn::Mul(t_max, e.abs_det), hn::Set(d, 1 + 0x1p-21f));
  e.mask = hn::And(
      e.mask, hn::And(hn::Le(signed_t, limit), hn::Ge(signed_t, hn::Neg(ray.t_scale))));
}

/// Distances of the lanes of e.mask, and the decision whether they lie ahead of the
/// origin. `is_ahead(mask)` decides the sign of t of some lanes exactly (PlaneIsAhead);
/// it is called for rays that start on the triangle.
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>, class IsAhead>
LANELIGHT_INLINE TriangleHits<V, M> FinishHits(D d, const Shear<V>& ray,
                                               const Corners<V>& at,
                                               const TriangleEdges<V, M>& e,
                                               IsAhead&& is_ahead) {
  TriangleHits<V, M> hit{e.mask, hn::Div(e.t_det, e.det), e.v, e.w, e.det};
  hit.mask = hn::And(e.mask, hn::Gt(hit.t, hn::Zero(d)));
  // A hit that is ahead only by the exact test below keeps the least positive distance.
  hit.t = hn::Max(hit.t, hn::Set(d, FLT_MIN));
  // Large triangles often straddle and small ones often have a small t det: few do both.
  const M near = hn::And(Straddles(d, at), hn::Le(hn::Abs(e.t_det), ray.t_scale));
  if (HWY_LIKELY(hn::AllFalse(d, hn::And(e.mask, near)))) return hit;
  const M uncertain = UncertainSign(d, ray, at, e.t_det, hn::And(e.mask, near));
  if (hn::AllFalse(d, uncertain)) return hit;
  hit.mask =
      hn::Or(hn::AndNot(uncertain, hit.mask), hn::And(uncertain, is_ahead(uncertain)));
  return hit;
}

/// Tests a sheared triangle against the lanes of `tested`, most of which miss.
template <class V, class M, class IsAhead>
LANELIGHT_INLINE TriangleHits<V, M> TestTriangle(const Shear<V>& ray,
                                                 const Corners<V>& at, V t_max, M tested,
                                                 IsAhead&& is_ahead) {
  const hn::DFromV<V> d;
  TriangleEdges<V, M> e = TestEdges(d, at);
  e.mask = hn::And(e.mask, tested);
  const V zero = hn::Zero(d);
  if (HWY_LIKELY(hn::AllFalse(d, e.mask))) return {e.mask, zero, zero, zero, zero};
  TestDistance(d, ray, at, t_max, e);
  if (hn::AllFalse(d, e.mask)) return {e.mask, zero, zero, zero, zero};
  return FinishHits(d, ray, at, e, is_ahead);
}

LANELIGHT_END_KERNELS

#endif
