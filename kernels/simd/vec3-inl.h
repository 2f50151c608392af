// Three vectors that form a vector of points or directions, one per lane.
#ifndef LANELIGHT_SIMD_VEC3_INL_H_
#define LANELIGHT_SIMD_VEC3_INL_H_

#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

struct V3 {
  VF x, y, z;
};

HWY_INLINE VF Splat(float v) { return hn::Set(DF(), v); }
HWY_INLINE V3 Splat3(float x, float y, float z) { return {Splat(x), Splat(y), Splat(z)}; }

HWY_INLINE V3 operator+(V3 a, V3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(V3 a, V3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 operator-(V3 a) { return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)}; }
HWY_INLINE V3 Mul(V3 a, V3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE V3 Mul(V3 a, VF s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
/// a * s + b
HWY_INLINE V3 MulAdd(V3 a, VF s, V3 b) {
  return {hn::MulAdd(a.x, s, b.x), hn::MulAdd(a.y, s, b.y), hn::MulAdd(a.z, s, b.z)};
}
LANELIGHT_INLINE VF Dot(V3 a, V3 b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
/// a*b - c*d with an error below 1.5 ulp (Kahan; Jeannerod, Louvet and Muller 2013).
LANELIGHT_INLINE VF DifferenceOfProducts(VF a, VF b, VF c, VF d) {
  const VF cd = hn::Mul(c, d);
  const VF difference = hn::MulSub(a, b, cd);
  const VF error = hn::NegMulAdd(c, d, cd);
  return hn::Add(difference, error);
}
LANELIGHT_INLINE V3 Cross(V3 a, V3 b) {
  return {DifferenceOfProducts(a.y, b.z, a.z, b.y),
          DifferenceOfProducts(a.z, b.x, a.x, b.z),
          DifferenceOfProducts(a.x, b.y, a.y, b.x)};
}
HWY_INLINE VF Rsqrt(VF x) { return hn::Div(Splat(1.0f), hn::Sqrt(x)); }
/// Undefined (NaN) for the zero vector.
LANELIGHT_INLINE V3 Normalize(V3 a) { return Mul(a, Rsqrt(Dot(a, a))); }
/// Unit length again for a vector whose squared length is 1 + e, |e| < 1e-3: a Newton
/// step instead of a root and a division. Relative error of the length 3/8 e^2 and
/// rounding.
LANELIGHT_INLINE V3 Renormalize(V3 a) {
  return Mul(a, hn::NegMulAdd(Splat(0.5f), Dot(a, a), Splat(1.5f)));
}
HWY_INLINE V3 IfThenElse(MF m, V3 a, V3 b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y),
          hn::IfThenElse(m, a.z, b.z)};
}
HWY_INLINE V3 IfThenElseZero(MF m, V3 a) {
  return {hn::IfThenElseZero(m, a.x), hn::IfThenElseZero(m, a.y),
          hn::IfThenElseZero(m, a.z)};
}
LANELIGHT_INLINE V3 Abs(V3 v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }
HWY_INLINE VF MaxComponent(V3 a) { return hn::Max(a.x, hn::Max(a.y, a.z)); }

template <class Index>
LANELIGHT_INLINE V3 Gather3(const float* x, const float* y, const float* z,
                            const Index& index) {
  return {Gather(x, index), Gather(y, index), Gather(z, index)};
}
template <class Index>
LANELIGHT_INLINE void Scatter3(V3 v, float* x, float* y, float* z, const Index& index) {
  Scatter(v.x, x, index);
  Scatter(v.y, y, index);
  Scatter(v.z, z, index);
}
/// Entries of a table of three floats each.
LANELIGHT_INLINE V3 Gather3(const float* table, VI index) {
  const VI at = hn::Mul(index, hn::Set(DI(), 3));
  return Gather3(table, table + 1, table + 2, at);
}

/// Tangent frame around unit normal n without branches or singularities (Duff et al.
/// 2017, "Building an Orthonormal Basis, Revisited").
struct ShadingFrame {
  V3 s, t, n;
  HWY_INLINE V3 ToLocal(V3 v) const { return {Dot(v, s), Dot(v, t), Dot(v, n)}; }
  HWY_INLINE V3 FromLocal(V3 v) const {
    return MulAdd(s, v.x, MulAdd(t, v.y, Mul(n, v.z)));
  }
};
LANELIGHT_INLINE ShadingFrame FrameFromNormal(V3 n) {
  const VF sign = hn::CopySignToAbs(Splat(1.0f), n.z);
  const VF a = hn::Div(Splat(-1.0f), hn::Add(sign, n.z));
  const VF b = hn::Mul(hn::Mul(n.x, n.y), a);
  const VF one = Splat(1.0f);
  return {{hn::MulAdd(hn::Mul(sign, n.x), hn::Mul(n.x, a), one), hn::Mul(sign, b),
           hn::Neg(hn::Mul(sign, n.x))},
          {b, hn::MulAdd(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)},
          n};
}

/// Origin of a ray leaving surface point p on the side of `direction`, clear of the
/// rounding error of p: p_error bounds it along the geometric normal ng.
LANELIGHT_INLINE V3 OffsetOrigin(V3 p, V3 ng, VF p_error, V3 direction) {
  const VF side = hn::CopySign(p_error, Dot(ng, direction));
  return MulAdd(ng, side, p);
}

LANELIGHT_END_KERNELS

#endif
