// points=halton: Owen-scrambled Halton points, padded from pairs of bases 2 and 3.
//   estimator   mean of f over a prefix of the sequence: every interval of size
//               2^-a 3^-b holds one of any 2^a 3^b successive points
//   scrambling  nested random permutations of the digits (Owen): in base 2 by the hash of
//               Laine and Karras, in base 3 by one of the six permutations of a digit,
//               chosen by a hash of the digits before it. Digits beyond the sequence's
//               are random. A random order within each [2^m, 2^(m+1)) (so that dimensions
//               do not follow each other, and prefixes of 2^m stay prefixes)
//   unbiased    each scrambled point is uniform, for any N
//   variance    near N^-2 for smooth f
//   dependence  the samples of one group share one randomisation: one observation
//   cost        a hash, a permutation and eight steps of twenty instructions per point
// Sources: Halton 1964; Owen 2017, "A randomized Halton algorithm in R".
#ifndef LANELIGHT_SAMPLERS_HALTON_INL_H_
#define LANELIGHT_SAMPLERS_HALTON_INL_H_

#include "kernels/samplers/group-inl.h"
#include "kernels/samplers/sobol-inl.h"

LANELIGHT_BEGIN_KERNELS

struct QuotientRemainder {
  VU quotient, remainder;
};

// i = 3 quotient + remainder for all i (2863311531 = (2^33 + 1) / 3).
LANELIGHT_INLINE QuotientRemainder DivideBy3(VU i) {
  const VU quotient = hn::ShiftRight<1>(MulHigh32(i, SplatU(2863311531u)));
  return {quotient, hn::Sub(i, hn::Mul(quotient, SplatU(3)))};
}

inline constexpr uint32_t kHaltonDigits3 = 8;
inline constexpr Strata kHaltonStrata = MakeStrata(6561);  // 3^8

/// Digits of i < 3^8 in base 3, reversed and scrambled, in 2^-32.
LANELIGHT_INLINE VU ScrambledInverse3(VU i, VU key) {
  VU tree = key;  // hash of the digits so far: the node of the tree of digits
  VU value = hn::Zero(DU());
  for (uint32_t d = 0; d < kHaltonDigits3; ++d) {
    const QuotientRemainder split = DivideBy3(i);
    i = split.quotient;
    tree = hn::Mul(hn::Xor(tree, hn::ShiftRight<16>(tree)), SplatU(0xee15164bu));
    tree = hn::Xor(tree, hn::ShiftRight<15>(tree));
    // The permutations of {0, 1, 2} are digit -> (digit + shift) or -(digit + shift).
    const VU choice = MulHigh32(tree, SplatU(6));
    const VU shift = hn::ShiftRight<1>(choice);
    const VU sign = hn::Add(hn::And(choice, SplatU(1)), SplatU(1));
    const VU image = hn::Mul(sign, hn::Add(split.remainder, shift));  // below 9
    const VU digit =
        hn::Sub(image, hn::Mul(SplatU(3), hn::ShiftRight<5>(hn::Mul(image, SplatU(11)))));
    value = hn::Add(hn::Mul(value, SplatU(3)), digit);
    tree = hn::Add(hn::Mul(tree, SplatU(0x91948cefu)),
                   hn::Mul(split.remainder, SplatU(0xd04112adu)));
  }
  tree = hn::Mul(hn::Xor(tree, hn::ShiftRight<16>(tree)), SplatU(0xb419ea8bu));
  tree = hn::Mul(hn::Xor(tree, hn::ShiftRight<14>(tree)), SplatU(0xb7f9d0b7u));
  return InStratum(kHaltonStrata, value, hn::Xor(tree, hn::ShiftRight<16>(tree)));
}

struct HaltonSequence : RoundRobinPoints {
  static LANELIGHT_INLINE void Point(const PointKey& of, VF* u0, VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU i = PermuteOctaves(at.index, h.x);
    // The hash takes the first digits of low numbers from the low bits of its seed, which
    // alone are no random numbers.
    const VU inverse2 = ReverseBits32(LaineKarras(i, h.y));
    *u0 = ToUnit(hn::Xor(inverse2, h.w));
    *u1 = ToUnit(ScrambledInverse3(i, h.z));
  }
};

LANELIGHT_END_KERNELS

#endif
