// Random permutations of [0, 2^m), one per key, without tables: swap-or-not rounds. Round
// r pairs each x with K_r - x modulo 2^m, and swaps the two or not, as a hash of the
// larger says.
//   uniform   tests/kernels/points/permute_test.cc bounds the bias of ten rounds on
//             images, pairs and, for few elements, whole permutations
//   cost      ten rounds of three multiplications and twelve cheap instructions,
//             whatever n
// Source: Hoang, Morris and Rogaway 2012, "An Enciphering Scheme Based on a Card
// Shuffle".
#ifndef LANELIGHT_POINTS_PERMUTE_INL_H_
#define LANELIGHT_POINTS_PERMUTE_INL_H_

#include "kernels/points/strata-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Applies ten rounds to x; pair(x, random) gives the partner of x under 32 random bits
/// of the round, such that pair(pair(x, random), random) = x.
template <class Pair>
LANELIGHT_INLINE VU SwapOrNot(VU x, VU key, Pair&& pair) {
  const DI di;
  VU other = hn::Mul(hn::Xor(key, hn::ShiftRight<15>(key)), SplatU(0xd23f38fbu));
  other = hn::Xor(other, hn::ShiftRight<14>(other));
  VU round = key;
  for (int i = 0; i < 10; ++i) {
    round = hn::Add(hn::Mul(round, SplatU(0x9e3e7241u)), SplatU(0x938ab4c9u));
    const VU partner = pair(x, hn::Xor(round, other));
    const VU larger = hn::Max(x, partner);
    const VU hash = hn::Mul(hn::Add(larger, other), hn::Or(round, SplatU(1)));
    const auto swap = hn::Lt(hn::BitCast(di, hash), hn::Zero(di));  // its top bit
    x = hn::IfThenElse(hn::RebindMask(DU(), swap), partner, x);
  }
  return x;
}

/// Returns the image of i in a permutation of [0, mask], mask = 2^m - 1 < 2^24.
LANELIGHT_INLINE VU PermuteMasked(VU i, VU mask, VU key) {
  return SwapOrNot(i, key, [&](VU x, VU random) HWY_ATTR {
    return hn::And(hn::Sub(hn::ShiftRight<8>(random), x), mask);
  });
}

/// Locates i < 2^24 among {0}, {1}, {2, 3}, [4, 8), [8, 16), ...
struct Octave {
  VU number;        // of the set, from 0 on
  VU log, mask;     // of its size: 2^log, and that less one
  VU first, place;  // its first element, and i less that
};
LANELIGHT_INLINE Octave OctaveOf(VU i) {
  const DU du;
  const VU some = hn::Max(i, SplatU(1));
  // The exponent of i as a float.
  const VF as_float = hn::ConvertTo(DF(), hn::BitCast(DI(), some));
  const VU log = hn::Sub(hn::ShiftRight<23>(hn::BitCast(du, as_float)), SplatU(127));
  const VU power = hn::Shl(SplatU(1), log);
  const auto zero = hn::Eq(i, hn::Zero(du));
  const VU first = hn::IfThenZeroElse(zero, power);
  const VU number = hn::IfThenZeroElse(zero, hn::Add(log, SplatU(1)));
  return {number, log, hn::Sub(power, SplatU(1)), first, hn::Sub(i, first)};
}

/// Returns the image of i in a permutation of [0, 2^24) that keeps 0 and permutes each
/// [2^m, 2^(m+1)) in itself. It thus keeps every prefix of 2^m numbers.
LANELIGHT_INLINE VU PermuteOctaves(VU i, VU key) {
  const Octave octave = OctaveOf(i);
  // A key for each octave: the rounds alone would permute them alike.
  VU own = hn::Add(key, hn::Mul(octave.log, SplatU(0xee15164bu)));
  own = hn::Mul(hn::Xor(own, hn::ShiftRight<16>(own)), SplatU(0xe6302d2bu));
  own = hn::Xor(own, hn::ShiftRight<15>(own));
  return hn::Add(octave.first, PermuteMasked(octave.place, octave.mask, own));
}

LANELIGHT_END_KERNELS

#endif
