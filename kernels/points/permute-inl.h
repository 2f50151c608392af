// Random permutations of [0, n), one per key, without tables: swap-or-not rounds. Round r
// pairs each x with K_r - x modulo n, and swaps the two or not, as a hash of the larger
// says.
//   uniform   tests/points/permute_test.cc bounds what ten rounds leave on images,
//             pairs and, for few elements, whole permutations
//   cost      ten rounds of three multiplications and twelve cheap instructions,
//             whatever n
// Source: Hoang, Morris and Rogaway 2012, "An Enciphering Scheme Based on a Card
// Shuffle".
#if defined(LANELIGHT_POINTS_PERMUTE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_PERMUTE_INL_H_
#undef LANELIGHT_POINTS_PERMUTE_INL_H_
#else
#define LANELIGHT_POINTS_PERMUTE_INL_H_
#endif

#include "kernels/points/strata-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Rounds on x; pair(x, random) gives the partner of x under 32 random bits of the round,
/// such that pair(pair(x, random), random) = x.
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

/// A permutation of [0, strata.count); i < strata.count <= 2^20.
LANELIGHT_INLINE VU Permute(const Strata& strata, VU i, VU key) {
  const VU count = SplatU(strata.count);
  // As many bits of a random number as its product with `count` leaves room for.
  const int unused = static_cast<int>(HWY_MAX(strata.bits, 1u)), used = 32 - unused;
  return SwapOrNot(i, key, [&](VU x, VU random) HWY_ATTR {
    const VU bits = hn::ShiftRightSame(random, unused);
    const VU sum = hn::ShiftRightSame(hn::Mul(bits, count), used);  // below count
    const VU partner = hn::Sub(sum, x);
    return hn::Min(partner, hn::Add(partner, count));  // modulo count
  });
}

/// A permutation of [0, 2^24) that keeps 0 and permutes each [2^m, 2^(m+1)) in itself, so
/// that it keeps every prefix of 2^m numbers. (The exponent of i as a float is m.)
LANELIGHT_INLINE VU PermuteOctaves(VU i, VU key) {
  const DU du;
  const VU some = hn::Max(i, SplatU(1));
  const VF as_float = hn::ConvertTo(DF(), hn::BitCast(DI(), some));
  const VU m = hn::Sub(hn::ShiftRight<23>(hn::BitCast(du, as_float)), SplatU(127));
  const VU first = hn::Shl(SplatU(1), m);
  const VU mask = hn::Sub(first, SplatU(1));
  // A key for each octave: the rounds alone would permute them alike.
  VU own = hn::Add(key, hn::Mul(m, SplatU(0xee15164bu)));
  own = hn::Mul(hn::Xor(own, hn::ShiftRight<16>(own)), SplatU(0xe6302d2bu));
  own = hn::Xor(own, hn::ShiftRight<15>(own));
  const VU x = SwapOrNot(hn::And(i, mask), own, [&](VU v, VU random) HWY_ATTR {
    return hn::And(hn::Sub(hn::ShiftRight<8>(random), v), mask);
  });
  return hn::IfThenElse(hn::Eq(i, hn::Zero(du)), i, hn::Or(first, x));
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
