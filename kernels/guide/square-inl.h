// The map between directions above a surface and the square of a guide's cell, as in
// src/prepare/guide_square.h, which says what it is.
#ifndef LANELIGHT_GUIDE_SQUARE_INL_H_
#define LANELIGHT_GUIDE_SQUARE_INL_H_

#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

LANELIGHT_INLINE Frame GuideFrame(V3 n) {
  const VF one = Splat(1.0f), zero = hn::Zero(DF());
  const MF by_x = hn::Lt(hn::Abs(n.x), Splat(0.7f));
  const VF along = hn::IfThenElse(by_x, n.x, n.y);
  const V3 axis = {hn::IfThenElse(by_x, one, zero), hn::IfThenElse(by_x, zero, one),
                   zero};
  const V3 flat = MulAdd(n, hn::Neg(along), axis);
  const V3 s = Mul(flat, hn::Div(one, hn::Sqrt(Dot(flat, flat))));
  return {s, Cross(n, s), n};
}

struct GuideSquarePoint {
  VF a, b;            // in [-1, 1]
  VF to_solid_angle;  // density over the square to pdf_sa; 0 below the surface
};

/// Of a direction in the frame, unit.
LANELIGHT_INLINE GuideSquarePoint ToGuideSquare(V3 local) {
  const VF one = Splat(1.0f), zero = hn::Zero(DF());
  const VF ax = hn::Abs(local.x), ay = hn::Abs(local.y);
  const MF wide = hn::Ge(ax, ay);
  const VF large = hn::Max(hn::Max(ax, ay), Splat(1e-30f));
  const VF t = hn::Div(hn::Min(ax, ay), large);
  const VF stretch = hn::MulAdd(t, t, one);
  const VF r = hn::Min(hn::Mul(large, hn::Sqrt(stretch)), one), rt = hn::Mul(r, t);
  return {hn::CopySign(hn::IfThenElse(wide, r, rt), local.x),
          hn::CopySign(hn::IfThenElse(wide, rt, r), local.y),
          hn::Mul(stretch, hn::Max(local.z, zero))};
}

/// The direction in the frame, unit.
LANELIGHT_INLINE V3 FromGuideSquare(VF a, VF b, VF* to_solid_angle) {
  const VF one = Splat(1.0f);
  const VF aa = hn::Abs(a), ab = hn::Abs(b);
  const VF t = hn::Div(hn::Min(aa, ab), hn::Max(hn::Max(aa, ab), Splat(1e-30f)));
  const VF stretch = hn::MulAdd(t, t, one);
  const VF shrink = hn::Div(one, hn::Sqrt(stretch));
  const VF x = hn::Mul(a, shrink), y = hn::Mul(b, shrink);
  const VF z2 = hn::NegMulAdd(x, x, hn::NegMulAdd(y, y, one));
  const VF z = hn::Sqrt(hn::Max(z2, hn::Zero(DF())));
  *to_solid_angle = hn::Mul(stretch, z);
  return {x, y, z};
}

LANELIGHT_END_KERNELS

#endif
