// points=sobol: Owen-scrambled Sobol' points, padded from two-dimensional nets.
//   estimator   mean of one randomised (0,2)-sequence per dimension pair; for smooth
//               integrands the variance of a power-of-two prefix falls like N^-3
//               (Owen 1997), never worse than a constant times sigma^2 / N
//   unbiased    each scrambled point is uniform; N need not be a power of two (then only
//               the rate is lost)
//   dependence  the samples of one group share one randomisation: one observation
//   cost        four bit reversals, four hashes and the Pascal-matrix product per point
// Sources: Burley 2020, "Practical Hash-based Owen Scrambling"; Laine and Karras 2011
// (the hash, here with the constants found by Vegdahl 2021); Joe and Kuo direction
// numbers of dimension 2 form Pascal's triangle mod 2.
#ifndef LANELIGHT_SAMPLERS_SOBOL_INL_H_
#define LANELIGHT_SAMPLERS_SOBOL_INL_H_

#include "kernels/samplers/group-inl.h"

LANELIGHT_BEGIN_KERNELS

// Random nested (Owen) permutation of bit-reversed numbers: bit i of the result depends
// on the bits below i only.
LANELIGHT_INLINE VU LaineKarras(VU x, VU seed) {
  x = hn::Xor(x, hn::Mul(x, SplatU(0x3d20adeau)));
  x = hn::Add(x, seed);
  x = hn::Mul(x, hn::Or(hn::ShiftRight<16>(seed), SplatU(1)));
  x = hn::Xor(x, hn::Mul(x, SplatU(0x05526c56u)));
  return hn::Xor(x, hn::Mul(x, SplatU(0x53a22864u)));
}

// Bit-reversed second Sobol' coordinate of index i: y_j = xor over k of C(k, j) i_k, and
// by Lucas C(k, j) is odd iff j is a submask of k, so one xor-shift per bit of the
// positions does the product with Pascal's triangle.
LANELIGHT_INLINE VU ReversedSobol1(VU i) {
  i = hn::Xor(i, hn::ShiftRight<16>(i));
  i = hn::Xor(i, hn::And(hn::ShiftRight<8>(i), SplatU(0x00ff00ffu)));
  i = hn::Xor(i, hn::And(hn::ShiftRight<4>(i), SplatU(0x0f0f0f0fu)));
  i = hn::Xor(i, hn::And(hn::ShiftRight<2>(i), SplatU(0x33333333u)));
  return hn::Xor(i, hn::And(hn::ShiftRight<1>(i), SplatU(0x55555555u)));
}

struct SobolSequence : RoundRobinPoints {
  static LANELIGHT_INLINE void Point(const PointKey& of, VF* u0, VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU shuffled = ReverseBits32(LaineKarras(ReverseBits32(at.index), h.x));
    *u0 = ToUnit(ReverseBits32(LaineKarras(shuffled, h.y)));
    *u1 = ToUnit(ReverseBits32(LaineKarras(ReversedSobol1(shuffled), h.z)));
  }
};

LANELIGHT_END_KERNELS

#endif
