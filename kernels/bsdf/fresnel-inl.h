// Fresnel equations for unpolarised light, in forms that keep their relative accuracy at
// grazing angles and for indices close to 1.
#ifndef LANELIGHT_BSDF_FRESNEL_INL_H_
#define LANELIGHT_BSDF_FRESNEL_INL_H_

#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Reflectance and refraction of a smooth dielectric interface at incident cosine c.
struct Interface {
  VF reflectance;
  VF cos_t;  // cosine of the refracted direction; 0 under total internal reflection
  VF bend;   // eta cos_t - c: how far the normal pulls the refracted direction
};

/// Returns c^2 + add, rounded about once: the sum may be much smaller than either.
LANELIGHT_INLINE VF SquarePlus(VF c, VF add) {
#if HWY_NATIVE_FMA
  return hn::MulAdd(c, c, add);
#else
  // The square of the upper 12 bits is exact (Dekker 1971).
  const VF high = hn::And(c, hn::BitCast(DF(), hn::Set(DU(), 0xfffff000u)));
  const VF low = hn::Sub(c, high);
  return hn::Add(hn::Add(hn::Mul(high, high), add), hn::Mul(low, hn::Add(high, c)));
#endif
}

/// Interface with relative index eta (transmitted over incident, > 0), c in [0, 1].
/// With g = eta cos_t = sqrt(eta^2 - 1 + c^2) the perpendicular amplitude is
/// (g - c) / (g + c) = (eta^2 - 1) / (g + c)^2, and the parallel one is that times
/// (c (g + c) - 1) / (c (g - c) + 1) (Walter et al. 2007, equation 22): the differences
/// of nearly equal numbers are gone. eta = 1 gives exactly 0.
LANELIGHT_INLINE Interface DielectricInterface(VF c, VF eta) {
  const VF one = Splat(1.0f), zero = hn::Zero(DF());
  const VF contrast = hn::Mul(hn::Sub(eta, one), hn::Add(eta, one));
  const VF g2 = SquarePlus(c, contrast);
  const MF total = hn::Lt(g2, zero);
  const VF g = hn::Sqrt(hn::Max(g2, zero));
  const VF sum = hn::Max(hn::Add(g, c), Splat(1e-18f));
  const VF bend = hn::Div(contrast, sum);
  const VF perpendicular = hn::Div(bend, sum);
  const VF ratio = hn::Div(hn::MulSub(c, sum, one), hn::MulAdd(c, bend, one));
  const VF sum_of_squares = hn::Mul(Sqr(perpendicular), hn::MulAdd(ratio, ratio, one));
  const VF partial = hn::Min(hn::Mul(Splat(0.5f), sum_of_squares), one);
  return {hn::IfThenElse(total, one, partial), hn::Div(g, eta), bend};
}

/// Returns the direction refracted at microfacet normal m, on wo's side of it (Snell's
/// law):
/// -(wo + bend m) / eta. Meaningless under total internal reflection.
LANELIGHT_INLINE V3 Refract(V3 wo, V3 m, VF bend, VF eta) {
  return Mul(MulAdd(m, bend, wo), hn::Div(Splat(-1.0f), eta));
}
/// Returns the mirror direction 2 (wo.m) m - wo, given cosine = wo.m.
LANELIGHT_INLINE V3 Reflect(V3 wo, V3 m, VF cosine) {
  return MulAdd(m, hn::Add(cosine, cosine), -wo);
}

/// Reflectance of a conductor of complex index eta + i k relative to the medium above, at
/// incident cosine c in [0, 1]. With a + i b = sqrt((eta + i k)^2 - sin^2), a, b >= 0:
///   Rs = ((a - c)^2 + b^2) / ((a + c)^2 + b^2)
///   Rp = Rs ((a c - s^2)^2 + b^2 c^2) / ((a c + s^2)^2 + b^2 c^2),  s^2 = 1 - c^2
/// (Born and Wolf, section 14.2). The larger of a, b comes from a root without
/// cancellation and the other from a b = eta k; a - c = (eta^2 - k^2 - 1 + b^2) / (a +
/// c).
LANELIGHT_INLINE VF FresnelConductor(VF c, VF eta, VF k) {
  const VF one = Splat(1.0f), half = Splat(0.5f), zero = hn::Zero(DF());
  const VF s2 = hn::Mul(hn::Sub(one, c), hn::Add(one, c));
  const VF contrast = hn::NegMulAdd(
      k, k, hn::Mul(hn::Sub(eta, one), hn::Add(eta, one)));  // eta^2 - k^2 - 1
  const VF real = hn::MulAdd(c, c, contrast);
  const VF product = hn::Mul(eta, k);
  const VF modulus = hn::Sqrt(hn::MulAdd(real, real, hn::Mul(Splat(4.0f), Sqr(product))));
  const VF large = hn::Sqrt(hn::Mul(half, hn::Add(modulus, hn::Abs(real))));
  const VF safe = hn::IfThenElse(hn::Gt(large, zero), large, one);
  const VF small = hn::Div(product, safe);
  const MF positive = hn::Ge(real, zero);
  const VF a = hn::IfThenElse(positive, large, small);
  const VF b = hn::IfThenElse(positive, small, large);
  const VF b2 = Sqr(b);
  const VF sum = hn::Max(hn::Add(a, c), Splat(1e-18f));
  const VF difference = hn::Div(hn::Add(contrast, b2), sum);
  const VF rs_top = hn::MulAdd(difference, difference, b2);
  const VF rs_bottom = hn::MulAdd(sum, sum, b2);
  const VF ac = hn::Mul(a, c), bc2 = hn::Mul(b2, Sqr(c));
  const VF low = hn::Sub(ac, s2), high = hn::Add(ac, s2);
  const VF rp_top = hn::MulAdd(low, low, bc2), rp_bottom = hn::MulAdd(high, high, bc2);
  // (rs + rp) / 2 over the common denominator.
  const VF top = hn::Mul(hn::Mul(half, rs_top), hn::Add(rp_bottom, rp_top));
  const VF bottom = hn::Max(hn::Mul(rs_bottom, rp_bottom), Splat(1e-36f));
  return hn::Min(hn::Div(top, bottom), one);
}

LANELIGHT_INLINE V3 FresnelConductor(VF c, V3 eta, V3 k) {
  return {FresnelConductor(c, eta.x, k.x), FresnelConductor(c, eta.y, k.y),
          FresnelConductor(c, eta.z, k.z)};
}

LANELIGHT_END_KERNELS

#endif
