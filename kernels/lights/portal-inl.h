// Environments seen through a portal: look-up, and sampling of the part of the map that a
// point sees, by the summed weights of its texels (src/scene/compiled/lights.h, Portal).
//   density     pdf(s, t) = weight of the texel / weight of the window, both per area;
//               pdf_sa = pdf(s, t) / (solid angle per area of the square)
//   window      the part of the square that the portal covers: a rectangle
//   source      Bitterli, Novak and Jarosz 2015
// The long routines are called, not inlined: each has hundreds of instructions for a
// vector, and a kernel that holds all their copies takes half a minute to compile.
#ifndef LANELIGHT_LIGHTS_PORTAL_INL_H_
#define LANELIGHT_LIGHTS_PORTAL_INL_H_

#include "hwy/contrib/math/math-inl.h"
#include "kernels/lights/environment-inl.h"
#include "kernels/lights/portal_sums-inl.h"
#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

struct PortalPlace {
  VF s, t;
  VF solid_angle;  // per area of the square
  MF ahead;        // towards the outside
};

struct PortalWindow {
  VF s0, s1, t0, t1;
  MF open;
};

LANELIGHT_INLINE V3 LoadV3(const float v[3]) { return Splat3(v[0], v[1], v[2]); }

inline HWY_NOINLINE PortalPlace PlaceOf(const Portal& portal, V3 direction) {
  const V3 w = {Dot(LoadV3(portal.x_axis), direction),
                Dot(LoadV3(portal.y_axis), direction),
                Dot(LoadV3(portal.z_axis), direction)};
  const VF one = Splat(1.0f), half = Splat(0.5f), inv_pi = Splat(kInvPi);
  const MF ahead = hn::Gt(w.z, Splat(0));
  const VF inverse = hn::IfThenElseZero(ahead, hn::Div(one, w.z));
  const VF cosines = hn::Mul(hn::NegMulAdd(w.x, w.x, one), hn::NegMulAdd(w.y, w.y, one));
  return {hn::MulAdd(hn::Atan(DF(), hn::Mul(w.x, inverse)), inv_pi, half),
          hn::MulAdd(hn::Atan(DF(), hn::Mul(w.y, inverse)), inv_pi, half),
          hn::Mul(hn::Mul(cosines, inverse), Splat(kPi * kPi)), ahead};
}

LANELIGHT_INLINE V3 DirectionAt(const Portal& portal, VF s, VF t) {
  const VF half = Splat(0.5f);
  const auto [sin_a, cos_a] = SinCos2Pi(hn::Mul(hn::Sub(s, half), half));
  const auto [sin_b, cos_b] = SinCos2Pi(hn::Mul(hn::Sub(t, half), half));
  return Normalize(MulAdd(LoadV3(portal.x_axis), hn::Mul(sin_a, cos_b),
                          MulAdd(LoadV3(portal.y_axis), hn::Mul(cos_a, sin_b),
                                 Mul(LoadV3(portal.z_axis), hn::Mul(cos_a, cos_b)))));
}

LANELIGHT_INLINE PortalWindow WindowFrom(const Portal& portal, V3 from) {
  const PortalPlace low = PlaceOf(portal, Normalize(LoadV3(portal.low) - from));
  const PortalPlace high = PlaceOf(portal, Normalize(LoadV3(portal.high) - from));
  const MF wide = hn::And(hn::Lt(low.s, high.s), hn::Lt(low.t, high.t));
  return {low.s, high.s, low.t, high.t, hn::And(wide, hn::And(low.ahead, high.ahead))};
}

template <bool kUpper>
LANELIGHT_INLINE PortalSums SumsOf(const Portal& portal, const PortalWindow& w) {
  const VD size = hn::Set(DD(), portal.size);
  const auto texels = [&](VF v) HWY_ATTR {
    const VF inside = hn::IfThenElse(w.open, v, Splat(0.5f));
    return hn::Mul(HalfOf<kUpper>(inside), size);
  };
  return {portal, texels(w.s0), texels(w.s1), texels(w.t0), texels(w.t1)};
}

LANELIGHT_INLINE V3 PortalTexel(const Portal& portal, VF column, VF row) {
  const VF size = Splat(static_cast<float>(portal.size));
  const DI di;
  const VI texel = hn::Add(hn::Mul(hn::ConvertTo(di, row), hn::ConvertTo(di, size)),
                           hn::ConvertTo(di, column));
  return Gather3(portal.rgb.data(), texel);
}

/// Draws a direction that `from` sees through the portal, with density proportional to
/// the weight of its texel.
inline HWY_NOINLINE MapSample SamplePortal(const Portal& portal, V3 from, VF u0, VF u1) {
  const PortalWindow window = WindowFrom(portal, from);
  const PortalSums low = SumsOf<false>(portal, window),
                   high = SumsOf<true>(portal, window);
  const auto a = low.Sample(HalfOf<false>(u0), HalfOf<false>(u1));
  const auto b = high.Sample(HalfOf<true>(u0), HalfOf<true>(u1));
  const VF per_texel = Splat(1.0f / static_cast<float>(portal.size));
  MapSample out;
  out.direction = DirectionAt(portal, hn::Mul(FromHalves(a.x, b.x), per_texel),
                              hn::Mul(FromHalves(a.y, b.y), per_texel));
  const PortalPlace place = PlaceOf(portal, out.direction);
  const MF seen = hn::And(window.open, place.ahead);
  out.pdf_sa = hn::IfThenElseZero(
      seen, hn::Div(FromHalves(a.density, b.density), place.solid_angle));
  const V3 rgb =
      PortalTexel(portal, FromHalves(a.column, b.column), FromHalves(a.row, b.row));
  out.radiance = IfThenElseZero(seen, rgb);
  return out;
}

/// Returns radiance and density of a direction from `from`.
inline HWY_NOINLINE MapSample LookThrough(const Portal& portal, V3 from, V3 direction) {
  const PortalWindow w = WindowFrom(portal, from);
  const PortalPlace place = PlaceOf(portal, direction);
  const auto inside = [](VF v, VF low, VF high)
                          HWY_ATTR { return hn::And(hn::Ge(v, low), hn::Le(v, high)); };
  const MF seen =
      hn::And(hn::And(w.open, place.ahead),
              hn::And(inside(place.s, w.s0, w.s1), inside(place.t, w.t0, w.t1)));
  const VF size = Splat(static_cast<float>(portal.size));
  const auto texel = [&](VF v) HWY_ATTR {
    const VF at = hn::Min(hn::Floor(hn::Mul(v, size)), hn::Sub(size, Splat(1.0f)));
    return hn::IfThenElseZero(seen, at);
  };
  const VF column = texel(place.s), row = texel(place.t);
  const VD a =
      SumsOf<false>(portal, w).Density(HalfOf<false>(column), HalfOf<false>(row));
  const VD b = SumsOf<true>(portal, w).Density(HalfOf<true>(column), HalfOf<true>(row));
  return {direction, IfThenElseZero(seen, PortalTexel(portal, column, row)),
          hn::IfThenElseZero(seen, hn::Div(FromHalves(a, b), place.solid_angle))};
}

LANELIGHT_END_KERNELS

#endif
