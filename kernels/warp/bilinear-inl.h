// Points of the unit square with a density that is bilinear in the weights of its
// corners.
//   density     b(u) = 4 (w00 (1 - u0) (1 - u1) + w10 u0 (1 - u1) + w01 (1 - u0) u1
//               + w11 u0 u1) / (w00 + w10 + w01 + w11)
//   method      u1 from its marginal, which is linear, then u0 given u1, linear as well;
//               the root of the quadratic in the form without cancellation
//   error       below 1e-6 of the density of a point, for weights of one sign
//   source      Hart, Pharr, Muller, Lopes, McGuire and Shirley 2020, "Practical Product
//               Sampling by Fitting and Composing Warps"
#ifndef LANELIGHT_WARP_BILINEAR_INL_H_
#define LANELIGHT_WARP_BILINEAR_INL_H_

#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

struct UnitSquarePoint {
  VF u0, u1;
};

/// In [0, 1), with a density proportional to a + (b - a) x; a, b positive.
LANELIGHT_INLINE VF SampleLinear(VF u, VF a, VF b) {
  const VF a2 = Sqr(a);
  const VF root = hn::Sqrt(hn::MulAdd(u, hn::Sub(Sqr(b), a2), a2));
  const VF x = hn::Div(hn::Mul(u, hn::Add(a, b)), hn::Add(a, root));
  return hn::Min(x, Splat(1 - 0x1p-24f));
}

/// Weights of the corners (u0, u1), positive; 1e-6 to 1e6.
struct Bilinear {
  VF w00, w10, w01, w11;

  /// Of u0, u1 in [0, 1).
  LANELIGHT_INLINE UnitSquarePoint Sample(VF u0, VF u1) const {
    const VF v = SampleLinear(u1, hn::Add(w00, w10), hn::Add(w01, w11));
    return {SampleLinear(u0, Mix(v, w00, w01), Mix(v, w10, w11)), v};
  }
  /// Density over the square; its mean is 1.
  LANELIGHT_INLINE VF Pdf(UnitSquarePoint u) const {
    const VF here = Mix(u.u1, Mix(u.u0, w00, w10), Mix(u.u0, w01, w11));
    const VF sum = hn::Add(hn::Add(w00, w10), hn::Add(w01, w11));
    return hn::Div(hn::Mul(Splat(4.0f), here), sum);
  }

 private:
  static LANELIGHT_INLINE VF Mix(VF x, VF a, VF b) {
    return hn::MulAdd(x, hn::Sub(b, a), a);
  }
};

LANELIGHT_END_KERNELS

#endif
