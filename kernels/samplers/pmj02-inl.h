// points=pmj02: stored progressive multi-jittered (0,2) sequences
// (src/scene/prepare/pmj02.h), one of them chosen and scrambled at random.
//   estimator   mean of f over a prefix of 2^k points, of which every elementary interval
//               of base 2 of area 2^-k holds one
//   scrambling  random sequence, all binary digits xored with a random word (keeps the
//               elementary intervals), and a random order within each [2^m, 2^(m+1)) (so
//               that dimensions do not follow each other, and prefixes stay prefixes)
//   unbiased    the random word makes every point uniform; N need not be a power of two
//               (then only the rate is lost)
//   variance    N^-3 for smooth f, as Owen-scrambled Sobol' points, to the end of the
//               stored sequence
//   dependence  the samples of one group share one randomisation: one observation
//   cost        a hash, a short permutation and two gathers from a table of 64 KiB
// Source: Christensen, Kensler and Kilpatrick 2018, "Progressive Multi-Jittered Sample
// Sequences".
#ifndef LANELIGHT_SAMPLERS_PMJ02_INL_H_
#define LANELIGHT_SAMPLERS_PMJ02_INL_H_

#include "kernels/samplers/group-inl.h"
#include "src/scene/prepare/pmj02.h"

LANELIGHT_BEGIN_KERNELS

struct Pmj02Sequence : RoundRobinPoints {
  static LANELIGHT_INLINE void Point(const SamplerParameters& points, const PointKey& of,
                                     VF* u0, VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    static_assert((kPmj02Sequences & (kPmj02Sequences - 1)) == 0);
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU sequence = hn::And(h.w, SplatU(kPmj02Sequences - 1));
    const VU index = hn::Add(hn::Mul(sequence, SplatU(kPmj02SequenceLength)),
                             PermuteOctaves(at.index, h.x));
    const VI place = hn::BitCast(DI(), hn::ShiftLeft<1>(index));
    const VU x = AsUnsigned(Gather(points.pmj02, place));
    const VU y = AsUnsigned(Gather(points.pmj02 + 1, place));
    *u0 = ToUnit(hn::Xor(x, h.y));
    *u1 = ToUnit(hn::Xor(y, h.z));
  }
};

LANELIGHT_END_KERNELS

#endif
