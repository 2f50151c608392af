// points=cmj: correlated multi-jittered samples: one in each of a x b strata of two
// dimensions, and one in each of the a b strata of either dimension alone.
//   blocks      a pattern is made for its number of samples. So that nothing depends on
//               how many there will be, the first sample of a group is a block, the
//               second another, and each further one has as many samples as all before
//               it: 2, 4, 8, ..., with patterns of their own, 2^floor(m/2) x 2^ceil(m/2)
//               strata for 2^m. At powers of two all blocks are complete
//   estimator   mean of f(u0, u1) with, for the stratum (x, y),
//                 u0 = (x b + p(y) + xi) / (a b), u1 = (y a + q(x) + eta) / (a b),
//               p and q random permutations, the same for all columns and all rows (that
//               is the correlation: it keeps samples of neighbouring strata apart), and a
//               random order of the strata
//   unbiased    p, q and the order are random permutations, so each sample is uniform
//   variance    of a block of N: N^-3 for the parts of smooth f that depend on one of the
//               two dimensions alone; N^-3/2 for the rest, since all columns share p and
//               with it the same error (independently jittered strata have N^-2). Of all
//               blocks: N^-2 and N^-3/2, because the smallest keep the error of theirs.
//               Measured in tests/kernels/samplers/convergence_test.cc
//   dependence  the samples of one block share the permutations; those of one group are
//               one observation
//   cost        two PCG-4D hashes and three permutations per point
// Source: Kensler 2013, "Correlated Multi-Jittered Sampling" (the permutations are ours:
// group-inl.h, the blocks too).
#ifndef LANELIGHT_SAMPLERS_CMJ_INL_H_
#define LANELIGHT_SAMPLERS_CMJ_INL_H_

#include "kernels/samplers/group-inl.h"

LANELIGHT_BEGIN_KERNELS

struct CmjSequence : RoundRobinPoints {
  static LANELIGHT_INLINE void Point(const SamplerParameters&, const PointKey& of, VF* u0,
                                     VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const Octave block = OctaveOf(at.index);
    // Groups are far fewer than 2^24.
    const VU of_block = hn::Add(at.group, hn::ShiftLeft<24>(block.number));
    const U4 h = Pcg4d({pixel, of_block, key, seed});
    const U4 jitter = Pcg4d({at.index, h.y, h.z, h.w});
    // 2^columns x 2^rows strata.
    const VU columns = hn::ShiftRight<1>(block.log), rows = hn::Sub(block.log, columns);
    const VU column_mask = hn::Sub(hn::Shl(SplatU(1), columns), SplatU(1));
    const VU row_mask = hn::Sub(hn::Shl(SplatU(1), rows), SplatU(1));
    const VU cell = PermuteMasked(block.place, block.mask, h.x);
    const VU x = hn::And(cell, column_mask), y = hn::Shr(cell, columns);
    const VU fine0 = hn::Add(hn::Shl(x, rows), PermuteMasked(y, row_mask, h.y));
    const VU fine1 = hn::Add(hn::Shl(y, columns), PermuteMasked(x, column_mask, h.z));
    *u0 = ToUnit(InBinaryStratum(fine0, block.log, jitter.x));
    *u1 = ToUnit(InBinaryStratum(fine1, block.log, jitter.y));
  }
};

LANELIGHT_END_KERNELS

#endif
