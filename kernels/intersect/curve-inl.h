// One ray against a vector of pieces of curves (cubic Bezier curves, nearly straight).
//
// A curve is as wide as it looks to the ray: the ray meets it where it passes the curve
// nearest, as seen along itself, within half the width there, and at the depth of that
// place (as pbrt-v4). So, in the plane across the ray, with the ray at the origin, hits
// are places u where
//   c(u) . c'(u) = 0   rising: the distance is least
//   |c(u)| <= r(u)
// Ends are cut straight across the curve: there the product does not vanish. A place
// is none where the ray is nearer than half the width, across the curve: a ray that
// starts on a curve, which is as far from its middle line at most, would meet it again
// (Embree leaves out twice as much). Instead of pbrt's recursion to lines, roots are
// bracketed between a few places along each piece, which all lanes look at together, and
// then refined.
#ifndef LANELIGHT_INTERSECT_CURVE_INL_H_
#define LANELIGHT_INTERSECT_CURVE_INL_H_

#include "kernels/intersect/bvh-inl.h"
#include "kernels/intersect/round-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Brackets of a piece: many where the ray goes along it, as it is then seen as bent as
/// it may be. And steps to the root in one: Newton's, or halves where those leave the
/// bracket.
inline constexpr int kCurveBrackets = 4, kAlongBrackets = 16, kCurveSteps = 4;

/// Rays do not meet curves nearer than this times half their width there, which covers
/// curves that grow narrower.
inline constexpr float kCurveClearance = 1.1f;

/// Pieces in the coordinates of a ray: x and y across it, z along it.
template <class V>
struct VisiblePieces {
  V x[4], y[4], z[4], radius[2];
};

/// A ray with directions across it.
struct CurveRay {
  P3<V8> o, x, y, z;
};

/// `d` is a unit vector.
LANELIGHT_INLINE CurveRay MakeCurveRay(const float o[3], const float d[3]) {
  const D8 d8;
  const auto set = [&](float a, float b, float c) HWY_ATTR {
    return P3<V8>{hn::Set(d8, a), hn::Set(d8, b), hn::Set(d8, c)};
  };
  // As FrameFromNormal.
  const float sign = std::copysign(1.0f, d[2]), a = -1 / (sign + d[2]);
  const float b = d[0] * d[1] * a;
  return {set(o[0], o[1], o[2]), set(1 + sign * d[0] * d[0] * a, sign * b, -sign * d[0]),
          set(b, sign + d[1] * d[1] * a, -d[1]), set(d[0], d[1], d[2])};
}

LANELIGHT_INLINE VisiblePieces<V8> PiecesAlong(const CurveBlock& block, int i,
                                               const CurveRay& ray) {
  const D8 d8;
  VisiblePieces<V8> seen;
  for (int k = 0; k < 4; ++k) {
    const P3<V8> p =
        Sub({hn::Load(d8, block.p[k][0] + i), hn::Load(d8, block.p[k][1] + i),
             hn::Load(d8, block.p[k][2] + i)},
            ray.o);
    seen.x[k] = Dot(p, ray.x);
    seen.y[k] = Dot(p, ray.y);
    seen.z[k] = Dot(p, ray.z);
  }
  seen.radius[0] = hn::Load(d8, block.radius[0] + i);
  seen.radius[1] = hn::Load(d8, block.radius[1] + i);
  return seen;
}

/// Lanes whose hull, widened, the ray may meet before t_max: as a box along the chord. A
/// chord of no length rejects nothing.
LANELIGHT_INLINE M8 MayMeet(const VisiblePieces<V8>& s, V8 t_max) {
  const D8 d8;
  const V8 cx = hn::Sub(s.x[3], s.x[0]), cy = hn::Sub(s.y[3], s.y[0]);
  const V8 r = hn::Max(s.radius[0], s.radius[1]);
  const V8 reach = hn::Mul(r, hn::Sqrt(hn::MulAdd(cx, cx, hn::Mul(cy, cy))));
  const auto spans = [&](const V8 a[4], V8 low, V8 high) HWY_ATTR {
    const V8 lowest = hn::Min(hn::Min(a[0], a[1]), hn::Min(a[2], a[3]));
    const V8 highest = hn::Max(hn::Max(a[0], a[1]), hn::Max(a[2], a[3]));
    return hn::And(hn::Le(lowest, high), hn::Ge(highest, low));
  };
  V8 across[4], along[4];
  for (int k = 0; k < 4; ++k) {
    across[k] = hn::MulSub(cx, s.y[k], hn::Mul(cy, s.x[k]));
    along[k] = hn::MulAdd(cx, s.x[k], hn::Mul(cy, s.y[k]));
  }
  const V8 back = hn::Neg(reach);
  return hn::And(hn::And(spans(across, back, reach), spans(along, back, reach)),
                 spans(s.z, hn::Zero(d8), t_max));
}

/// A cubic polynomial: of one coordinate of a Bezier curve.
template <class V>
struct Cubic {
  V a0, a1, a2, a3;

  LANELIGHT_INLINE explicit Cubic(const V p[4]) : a0(p[0]) {
    const hn::DFromV<V> d;
    const V three = hn::Set(d, 3.0f), e0 = hn::Sub(p[1], p[0]), e1 = hn::Sub(p[2], p[1]),
            e2 = hn::Sub(p[3], p[2]);
    const V s0 = hn::Sub(e1, e0), s1 = hn::Sub(e2, e1);
    a1 = hn::Mul(three, e0);
    a2 = hn::Mul(three, s0);
    a3 = hn::Sub(s1, s0);
  }
  LANELIGHT_INLINE V At(V u) const {
    return hn::MulAdd(hn::MulAdd(hn::MulAdd(a3, u, a2), u, a1), u, a0);
  }
  LANELIGHT_INLINE V Slope(V u) const {
    const V two_a2 = hn::Add(a2, a2), three_a3 = hn::Add(a3, hn::Add(a3, a3));
    return hn::MulAdd(hn::MulAdd(three_a3, u, two_a2), u, a1);
  }
  LANELIGHT_INLINE V Bend(V u) const {
    const V six_a3 = hn::Mul(hn::Set(hn::DFromV<V>(), 6.0f), a3);
    return hn::MulAdd(six_a3, u, hn::Add(a2, a2));
  }
};

/// Half the derivative of the squared distance along a piece.
struct Nearing {
  Cubic<V8> x, y;

  LANELIGHT_INLINE explicit Nearing(const VisiblePieces<V8>& s) : x(s.x), y(s.y) {}
  LANELIGHT_INLINE V8 At(V8 u) const {
    return hn::MulAdd(x.At(u), x.Slope(u), hn::Mul(y.At(u), y.Slope(u)));
  }
  /// Its derivative.
  LANELIGHT_INLINE V8 Slope(V8 u) const {
    const V8 dx = x.Slope(u), dy = y.Slope(u);
    const V8 turn = hn::MulAdd(x.At(u), x.Bend(u), hn::Mul(y.At(u), y.Bend(u)));
    return hn::Add(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), turn);
  }
  /// The root between places where it is not above and above zero.
  LANELIGHT_INLINE V8 Root(V8 low, V8 high, V8 at_low, V8 at_high) const {
    const D8 d8;
    const V8 fraction = hn::Div(at_low, hn::Sub(at_low, at_high));
    V8 u = hn::MulAdd(hn::Sub(high, low), fraction, low);
    for (int i = 0; i < kCurveSteps; ++i) {
      const V8 value = At(u);
      const M8 above = hn::Gt(value, hn::Zero(d8));
      high = hn::IfThenElse(above, u, high);
      low = hn::IfThenElse(above, low, u);
      const V8 next = hn::Sub(u, hn::Div(value, Slope(u)));
      const M8 inside = hn::And(hn::Ge(next, low), hn::Le(next, high));
      const V8 middle = hn::Mul(hn::Set(d8, 0.5f), hn::Add(low, high));
      u = hn::IfThenElse(inside, next, middle);
    }
    return u;
  }
};

/// The same at an end, whose direction is that to the first other point, or the second:
/// where points coincide the curve does begin or end in a direction, but without speed.
LANELIGHT_INLINE V8 NearingEnd(const VisiblePieces<V8>& s, int end, int step) {
  const D8 d8;
  const auto toward = [&](const V8 a[4], int k) HWY_ATTR {
    const V8 e = hn::Sub(a[end + k * step], a[end]);
    return step < 0 ? hn::Neg(e) : e;
  };
  V8 dx = toward(s.x, 1), dy = toward(s.y, 1);
  for (int k = 2; k < 4; ++k) {
    const M8 none = hn::And(hn::Eq(dx, hn::Zero(d8)), hn::Eq(dy, hn::Zero(d8)));
    dx = hn::IfThenElse(none, toward(s.x, k), dx);
    dy = hn::IfThenElse(none, toward(s.y, k), dy);
  }
  return hn::MulAdd(s.x[end], dx, hn::Mul(s.y[end], dy));
}

/// Returns whether a ray goes along one of the pieces, within 20 degrees.
LANELIGHT_INLINE bool IsAlongCurve(const VisiblePieces<V8>& s, M8 mask) {
  const D8 d8;
  const V8 x = hn::Sub(s.x[3], s.x[0]), y = hn::Sub(s.y[3], s.y[0]),
           z = hn::Sub(s.z[3], s.z[0]);
  const V8 across2 = hn::MulAdd(x, x, hn::Mul(y, y));
  const V8 along2 = hn::Mul(hn::Set(d8, 0.13f), hn::Mul(z, z));
  return !hn::AllFalse(d8, hn::And(mask, hn::Le(across2, along2)));
}

/// Calls found(mask, t, u, share) for hits on pieces in front of the ray: their distance,
/// place along the piece, and squared distance from its middle line over that of its
/// edge, at most 1. `mask`: the lanes to look at.
template <class Found>
LANELIGHT_INLINE void ForEachNearest(const VisiblePieces<V8>& s, M8 mask, Found&& found) {
  const D8 d8;
  const V8 zero = hn::Zero(d8), wider = hn::Sub(s.radius[1], s.radius[0]);
  const Nearing nearing(s);
  const Cubic<V8> depth(s.z);
  // t across the curve, t |c'| / length of the tangent in space, is long enough.
  const auto clear = [&](V8 u, V8 t, V8 r) HWY_ATTR {
    const V8 dx = nearing.x.Slope(u), dy = nearing.y.Slope(u), dz = depth.Slope(u);
    const V8 across2 = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
    const V8 lowest = hn::Mul(hn::Set(d8, kCurveClearance), r);
    return hn::And(hn::Gt(t, zero),
                   hn::Gt(hn::Mul(hn::Mul(t, t), across2),
                          hn::Mul(hn::Mul(lowest, lowest), hn::MulAdd(dz, dz, across2))));
  };
  V8 low = zero, at_low = NearingEnd(s, 0, 1);
  const int brackets = IsAlongCurve(s, mask) ? kAlongBrackets : kCurveBrackets;
  for (int i = 1; i <= brackets; ++i) {
    const bool last = i == brackets;
    const V8 high = hn::Set(d8, static_cast<float>(i) / static_cast<float>(brackets));
    const V8 at_high = last ? NearingEnd(s, 3, -1) : nearing.At(high);
    const M8 between =
        hn::And(mask, hn::And(hn::Le(at_low, zero), hn::Gt(at_high, zero)));
    if (!hn::AllFalse(d8, between)) {
      const V8 u = nearing.Root(low, high, at_low, at_high);
      const V8 x = nearing.x.At(u), y = nearing.y.At(u), t = depth.At(u);
      const V8 r = hn::MulAdd(wider, u, s.radius[0]);
      const V8 r2 = hn::Mul(r, r), d2 = hn::MulAdd(x, x, hn::Mul(y, y));
      const M8 meets = hn::And(between, hn::And(hn::Le(d2, r2), clear(u, t, r)));
      if (!hn::AllFalse(d8, meets)) found(meets, t, u, hn::Div(d2, r2));
    }
    low = high;
    at_low = at_high;
  }
}

LANELIGHT_END_KERNELS

#endif
