// Procedural textures, of surface coordinates or of places.
#ifndef LANELIGHT_TEXTURE_PATTERNS_INL_H_
#define LANELIGHT_TEXTURE_PATTERNS_INL_H_

#include "kernels/texture/mapping-inl.h"
#include "kernels/texture/noise-inl.h"

LANELIGHT_BEGIN_KERNELS

/// 1 where floor(x) is odd, else 0. Without integers, so that it holds for every float.
LANELIGHT_INLINE VF OddCell(VF x) {
  const VF cell = hn::Floor(x);
  return hn::NegMulAdd(Splat(2.0f), hn::Floor(hn::Mul(cell, Splat(0.5f))), cell);
}

/// Lanes whose cell (floor(s), floor(t)) shows the first colour: even sum.
LANELIGHT_INLINE MF EvenCell(VF s, VF t) { return hn::Eq(OddCell(s), OddCell(t)); }

/// The same in three dimensions.
LANELIGHT_INLINE MF EvenCell(V3 q) {
  const MF odd = hn::Eq(OddCell(q.x), OddCell(q.y));
  return hn::Eq(hn::IfThenZeroElse(odd, Splat(1.0f)), OddCell(q.z));
}

/// Returns the mean of a square wave over a triangle filter that reaches `reach` to
/// either side of x. The wave is 1 where floor(x) is even, else -1.
LANELIGHT_INLINE VF FilteredWave(VF x, VF reach) {
  const VF half = Splat(0.5f), one = Splat(1.0f), two = Splat(2.0f);
  const VF sign = hn::NegMulAdd(two, OddCell(x), one);
  // Up to a reach of 1/2 the filter covers one edge at most, that nearest to x.
  const VF in_cell = hn::Sub(x, hn::Floor(x));
  const VF edge = hn::Min(in_cell, hn::Sub(one, in_cell));
  const MF clear = hn::Ge(edge, reach);
  const VF safe = hn::IfThenElse(clear, one, reach);
  const VF beyond = hn::IfThenZeroElse(clear, hn::Sub(one, hn::Div(edge, safe)));
  const VF narrow = hn::Mul(sign, hn::NegMulAdd(beyond, beyond, one));
  const MF wide = hn::Gt(reach, half);
  if (hn::AllFalse(DF(), wide)) return narrow;
  // Else the second difference of the second integral of the wave, which has its period.
  const auto integral = [&](VF at) HWY_ATTR {
    const VF turns = hn::Mul(at, half);
    const VF y = hn::Sub(hn::Sub(turns, hn::Floor(turns)), half);
    return hn::Mul(y, hn::NegMulAdd(two, hn::Abs(y), one));
  };
  const VF difference =
      hn::NegMulAdd(two, integral(x),
                    hn::Add(integral(hn::Add(x, reach)), integral(hn::Sub(x, reach))));
  return hn::IfThenElse(wide, hn::Div(difference, hn::Mul(reach, reach)), narrow);
}

/// Returns the share of a checkerboard's second colour over a footprint about (s, t),
/// with pbrt-v4's filter: a triangle that reaches 1.5 times the longer step to either
/// side.
LANELIGHT_INLINE VF SecondOfChecks(const TexturePair& st, const MapSteps& d) {
  const auto reach = [](VF x, VF y) HWY_ATTR {
    return hn::Mul(Splat(1.5f), hn::Max(hn::Abs(x), hn::Abs(y)));
  };
  const VF product = hn::Mul(FilteredWave(st.s, reach(d.s_x, d.s_y)),
                             FilteredWave(st.t, reach(d.t_x, d.t_y)));
  return hn::NegMulAdd(Splat(0.5f), product, Splat(0.5f));
}

/// Returns the lanes inside of a dot. Half of the unit cells around integers have a dot
/// of radius 0.35, shifted within the cell, both by the noise of the cell.
inline HWY_NOINLINE MF InsideDot(VF s, VF t) {
  const VF half = Splat(0.5f), room = Splat(0.15f);
  const VF cell_s = hn::Floor(hn::Add(s, half)), cell_t = hn::Floor(hn::Add(t, half));
  const auto noise = [&](float a, float b) HWY_ATTR {
    return Noise({hn::Add(cell_s, Splat(a)), hn::Add(cell_t, Splat(b)), half});
  };
  const VF ds = hn::Sub(s, hn::MulAdd(room, noise(1.5f, 2.8f), cell_s));
  const VF dt = hn::Sub(t, hn::MulAdd(room, noise(4.5f, 9.8f), cell_t));
  const MF near = hn::Lt(hn::MulAdd(ds, ds, hn::Mul(dt, dt)), Splat(0.35f * 0.35f));
  return hn::And(near, hn::Gt(noise(0.5f, 0.5f), hn::Zero(DF())));
}

/// Waves whose height varies by a wind of a tenth of their frequency.
LANELIGHT_INLINE VF Windy(V3 q) {
  const VF wind = FBm(Mul(q, Splat(0.1f)), 3, 0.5f);
  return hn::Mul(hn::Abs(wind), FBm(q, 6, 0.5f));
}

/// Control points of the colours of pbrt's marble: each four successive ones are a cubic
/// Bezier curve.
inline constexpr int kMarbleSegments = 6;
inline constexpr float kMarbleColors[kMarbleSegments + 3][3] = {
    {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f},
    {0.5f, 0.5f, 0.5f},   {0.6f, 0.59f, 0.58f}, {0.58f, 0.58f, 0.6f},
    {0.58f, 0.58f, 0.6f}, {0.2f, 0.2f, 0.33f},  {0.58f, 0.58f, 0.6f}};

/// Returns the colour of marble, by de Casteljau's scheme; q is scaled.
inline HWY_NOINLINE V3 Marble(V3 q, int32_t octaves, float roughness, float variation) {
  const DI di;
  const VF phase = hn::MulAdd(Splat(variation), FBm(q, octaves, roughness), q.y);
  const VF turns = hn::Mul(phase, Splat(0.159154943f));
  const VF sine = SinCos2Pi(hn::Sub(turns, hn::Floor(turns))).sin;
  const VF half = Splat(0.5f);
  const VF x = hn::Mul(hn::MulAdd(half, sine, half), Splat(float{kMarbleSegments}));
  const VI last = hn::Set(di, kMarbleSegments - 1);
  const VI first = hn::Max(hn::Min(hn::ConvertTo(di, x), last), hn::Zero(di));
  const VF t = hn::Sub(x, hn::ConvertTo(DF(), first)), rest = hn::Sub(Splat(1.0f), t);
  V3 point[4];
  for (int i = 0; i < 4; ++i) {
    point[i] = Gather3(kMarbleColors[i], first);
  }
  for (int order = 3; order > 0; --order) {
    for (int i = 0; i < order; ++i) point[i] = Mul(point[i], rest) + Mul(point[i + 1], t);
  }
  return Mul(point[0], Splat(1.5f));
}

/// Evaluates the patterns of a place; those that pbrt has as float textures only are
/// grey.
LANELIGHT_INLINE V3 EvalPattern(const TextureNode& node, V3 p) {
  const V3 q = PlaceOf(node, p);
  if (node.kind == TextureKind::kMarble) {
    return Marble(q, node.octaves, node.roughness, node.variation);
  }
  VF value;
  if (node.kind == TextureKind::kFbm) {
    value = FBm(q, node.octaves, node.roughness);
  } else if (node.kind == TextureKind::kWrinkled) {
    value = Turbulence(q, node.octaves, node.roughness);
  } else {
    value = Windy(q);
  }
  return {value, value, value};
}

LANELIGHT_END_KERNELS

#endif
