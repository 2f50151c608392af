// points=stratified: jittered strata that subdivide as samples are added. 2^m
// successive samples of a group, from a multiple of 2^m on, fill 2^ceil(m/2) x
// 2^floor(m/2) strata with one sample each.
//   estimator   mean of f(x, y), x and y the even and odd bits of a number v
//               whose first m bits are, over 2^m samples, each once: the van der Corput
//               sequence with nested random permutations of order and digits, laid along
//               the Z-order curve. Scalars are v itself: 2^m strata in one dimension
//   unbiased    the permutations are random, so each sample is uniform, for any N
//   variance    N^-2 for two dimensions and smooth f, N^-3/2 at edges; N^-3 for one
//               dimension; never above independent samples in the stratified dimensions.
//               Nothing is gained for functions of many dimensions at once
//   dependence  the samples of one group share the permutations: one observation
//   cost        a PCG-4D hash, two nested permutations and a spread of bits per point
// Sources: the paper's section 3.5.3; Cook 1986, "Stochastic Sampling in Computer
// Graphics"; Mitchell 1996 (rates); Owen 1995 (nested permutations).
#ifndef LANELIGHT_SAMPLERS_STRATIFIED_INL_H_
#define LANELIGHT_SAMPLERS_STRATIFIED_INL_H_

#include "kernels/samplers/sobol-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Bits 1, 3, 5, ... of v, from the highest on: in the upper half of the result.
LANELIGHT_INLINE VU OddBits(VU v) {
  v = hn::And(v, SplatU(0xaaaaaaaau));
  v = hn::And(hn::Or(v, hn::ShiftLeft<1>(v)), SplatU(0xccccccccu));
  v = hn::And(hn::Or(v, hn::ShiftLeft<2>(v)), SplatU(0xf0f0f0f0u));
  v = hn::And(hn::Or(v, hn::ShiftLeft<4>(v)), SplatU(0xff00ff00u));
  return hn::And(hn::Or(v, hn::ShiftLeft<8>(v)), SplatU(0xffff0000u));
}

struct StratifiedSequence : RoundRobinPoints {
  /// A scrambled van der Corput point in 2^-32.
  static LANELIGHT_INLINE VU Along(GroupIndex at, const U4& h) {
    const VU shuffled = ReverseBits32(LaineKarras(ReverseBits32(at.index), h.x));
    return ReverseBits32(LaineKarras(shuffled, h.y));
  }

  static LANELIGHT_INLINE void Point(const PointKey& of, VF* u0, VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU along = Along(at, h);
    // Two times 16 bits are too few for floats; the rest is a hash of them.
    VU rest = hn::Mul(hn::Xor(along, h.z), SplatU(0xd04112adu));
    rest = hn::Mul(hn::Xor(rest, hn::ShiftRight<15>(rest)), SplatU(0xee15164bu));
    const VU x = hn::Or(OddBits(along), hn::ShiftRight<16>(rest));
    rest = hn::Mul(hn::Xor(rest, hn::ShiftRight<16>(rest)), SplatU(0xb419ea8bu));
    const VU y = hn::Or(OddBits(hn::ShiftLeft<1>(along)), hn::ShiftRight<16>(rest));
    *u0 = ToUnit(x);
    *u1 = ToUnit(y);
  }

  static LANELIGHT_INLINE VF Number(const PointKey& of) {
    const auto& [pixel, at, key, seed] = of;
    return ToUnit(Along(at, Pcg4d({pixel, at.group, key, seed})));
  }
};

LANELIGHT_END_KERNELS

#endif
