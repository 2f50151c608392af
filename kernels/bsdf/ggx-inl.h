// GGX (Trowbridge-Reitz) microfacets with the height-correlated Smith masking of pbrt-v4,
// in the frame of the shading normal; all directions here have z > 0.
#ifndef LANELIGHT_BSDF_GGX_INL_H_
#define LANELIGHT_BSDF_GGX_INL_H_

#include "kernels/bsdf/fresnel-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Everything is expressed by Spread(w) = |stretched w| = sqrt(z^2 + ax^2 x^2 + ay^2
/// y^2):
///   1 + Lambda(w) = (z + Spread(w)) / (2 z),  G1(w) = 2 z / (z + Spread(w)),
/// so that no formula divides by a cosine and all stay finite at grazing angles.
struct Ggx {
  VF ax, ay;  // roughness, clamped to [1e-4, 1e4]

  LANELIGHT_INLINE static Ggx FromAlpha(VF x, VF y) {
    const VF low = Splat(1e-4f), high = Splat(1e4f);
    return {hn::Clamp(x, low, high), hn::Clamp(y, low, high)};
  }

  LANELIGHT_INLINE VF StretchedLength(V3 w) const {
    const VF x = hn::Mul(ax, w.x), y = hn::Mul(ay, w.y);
    return hn::Sqrt(hn::MulAdd(w.z, w.z, hn::MulAdd(x, x, hn::Mul(y, y))));
  }

  /// Density of normals per solid angle of m and projected area (Walter et al. 2007,
  /// equation 33; anisotropic: Burley 2012): integral of D(m) cos = 1.
  LANELIGHT_INLINE VF D(V3 m) const {
    // 1 / (pi ax ay e^2) with e = (x / ax)^2 + (y / ay)^2 + z^2, times (ax ay)^4 above
    // and below: one division. Powers stay within 1e-32 and 1e32.
    const VF x = hn::Mul(m.x, ay), y = hn::Mul(m.y, ax), a = hn::Mul(ax, ay);
    const VF z = hn::Mul(m.z, a);
    const VF e = hn::MulAdd(x, x, hn::MulAdd(y, y, Sqr(z)));
    return hn::Div(hn::Mul(hn::Mul(Splat(kInvPi), a), Sqr(a)), Sqr(e));
  }

  /// Normal m with the density of normals visible from wo,
  ///   Dvis(m) = G1(wo) max(0, wo.m) D(m) / wo.z = 2 (wo.m) D(m) / (wo.z + Spread(wo)).
  /// Stretched, the microfacets are a hemisphere; a reflection off its visible part is
  /// uniform over a spherical cap (Dupuy and Benyoub 2023). Heights relative to the
  /// cap's rim are products, never differences. u in [0, 1)^2.
  LANELIGHT_INLINE V3 SampleVisible(V3 wo, VF u0, VF u1) const {
    const VF one = Splat(1.0f);
    const V3 v = Normalize({hn::Mul(ax, wo.x), hn::Mul(ay, wo.y), wo.z});
    const VF above = hn::Add(one, v.z);
    const VF height = hn::Mul(hn::Sub(one, u1), above);  // of cap + v: 1 - u1 > 0
    const VF flat2 = hn::MulAdd(v.x, v.x, hn::Mul(v.y, v.y));
    const VF one_plus_z =
        hn::Add(height, hn::Div(flat2, above));  // 1 - v.z = flat2/above
    const VF r = SafeSqrt(hn::Mul(hn::Mul(u1, above), one_plus_z));
    const SinCosPair phi = SinCos2Pi(u0);
    const V3 h = {hn::MulAdd(r, phi.cos, v.x), hn::MulAdd(r, phi.sin, v.y), height};
    return Normalize({hn::Mul(ax, h.x), hn::Mul(ay, h.y), h.z});
  }
};

/// Returns the masking of a pair of directions, given z and Spread of both:
/// G2 / (4 zo zi) * zi = zi / (2 (so zi + si zo)).
LANELIGHT_INLINE VF HalfPairMasking(VF zo, VF so, VF zi, VF si) {
  return hn::Div(zi, hn::MulAdd(so, zi, hn::Mul(si, zo)));
}

/// G2(wo, wi) / G1(wo): the weight of a sample of the visible normals.
LANELIGHT_INLINE VF MaskingRatio(VF zo, VF so, VF zi, VF si) {
  return hn::Mul(HalfPairMasking(zo, so, zi, si), hn::Add(zo, so));
}

LANELIGHT_END_KERNELS

#endif
