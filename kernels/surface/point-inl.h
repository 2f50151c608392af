// Surface points in double precision, rounded once, and how far off they may be.
//
// Intersection decides exactly on which side of a surface an origin lies
// (kernels/intersect/triangle-inl.h). A point therefore moves only as far as rounding can
// have put it on the wrong side. With u = 2^-24:
//   p is rounded once:              u sum |n_i p_i| along n
//   p + n p_error is rounded twice: 2u sum |n_i p_i| (product and sum without fma)
// Their sum is 3u; RoundingError gives 4u, plus a part of the shape's size that covers
// the double-precision roundings (2^-50 of it) where p is near the origin.
#ifndef LANELIGHT_SURFACE_POINT_INL_H_
#define LANELIGHT_SURFACE_POINT_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/fields.h"

LANELIGHT_BEGIN_KERNELS

/// The columns that every surface stage writes, where they exist.
inline constexpr FieldSet kSurfaceFields = fields::kPoint | fields::kNormal |
                                           fields::kTangents | fields::kUv |
                                           FieldSet{Field::material};

// Half a vector of floats, as doubles.
using DHalf = hn::Half<DF>;
using DD = hn::Rebind<double, DHalf>;
using VD = hn::Vec<DD>;

struct D3 {
  VD x, y, z;
};

LANELIGHT_INLINE VD LowerDouble(VF v) {
  return hn::PromoteTo(DD(), hn::LowerHalf(DHalf(), v));
}
LANELIGHT_INLINE VD UpperDouble(VF v) {
  return hn::PromoteTo(DD(), hn::UpperHalf(DHalf(), v));
}
template <bool kUpper>
LANELIGHT_INLINE VD HalfOf(VF v) {
  if constexpr (kUpper) return UpperDouble(v);
  return LowerDouble(v);
}
template <bool kUpper>
LANELIGHT_INLINE D3 HalfOf(V3 v) {
  return {HalfOf<kUpper>(v.x), HalfOf<kUpper>(v.y), HalfOf<kUpper>(v.z)};
}
LANELIGHT_INLINE VF FromHalves(VD lower, VD upper) {
  const DHalf dh;
  return hn::Combine(DF(), hn::DemoteTo(dh, upper), hn::DemoteTo(dh, lower));
}
LANELIGHT_INLINE V3 FromHalves(D3 lower, D3 upper) {
  return {FromHalves(lower.x, upper.x), FromHalves(lower.y, upper.y),
          FromHalves(lower.z, upper.z)};
}
LANELIGHT_INLINE VD Dot(D3 a, D3 b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
LANELIGHT_INLINE D3 Minus(D3 a, D3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// a * s + b
LANELIGHT_INLINE D3 MulAdd(D3 a, VD s, D3 b) {
  return {hn::MulAdd(a.x, s, b.x), hn::MulAdd(a.y, s, b.y), hn::MulAdd(a.z, s, b.z)};
}

/// See above. `size` bounds |p - reference points of the shape|.
LANELIGHT_INLINE VF RoundingError(V3 p, V3 n, VF size) {
  return hn::MulAdd(Splat(0x1p-22f), Dot(Abs(p), Abs(n)), hn::Mul(Splat(0x1p-48f), size));
}

LANELIGHT_END_KERNELS

#endif
