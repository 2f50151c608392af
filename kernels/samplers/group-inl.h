// Finds the randomisation of a sample, and the index of the sample in it. Random numbers
// in one of n equal strata, in fixed point: 32 bits after the point, of which a float
// keeps the first 24. Random permutations.
#ifndef LANELIGHT_SAMPLERS_GROUP_INL_H_
#define LANELIGHT_SAMPLERS_GROUP_INL_H_

#include "kernels/simd/rng-inl.h"
#include "src/vocabulary/path/replicates.h"
#include "src/vocabulary/path/run_parameters.h"

LANELIGHT_BEGIN_KERNELS

/// A group of samples shares one randomisation; different groups, pixels, keys and seeds
/// are independent of each other.
struct GroupIndex {
  VU group, index;
};

/// The key of a point: pixel, group of its samples, dimension, seed.
struct PointKey {
  VU pixel;
  GroupIndex at;
  VU key, seed;
};

/// Samples take turns at kReplicates groups (src/vocabulary/path/replicates.h). A group
/// ends with the sampler's sequence, after 2^group_shift points; then as many new ones
/// begin.
LANELIGHT_INLINE GroupIndex GroupRoundRobin(const SamplerParameters& points, VU sample) {
  constexpr int kLog = kLogReplicates;
  const int shift = static_cast<int>(points.group_shift);
  const VU cycle = hn::ShiftRight<kLog>(sample);
  const VU round = hn::ShiftRightSame(cycle, shift);
  const VU replicate = hn::And(sample, SplatU(kReplicates - 1));
  return {hn::Or(hn::ShiftLeft<kLog>(round), replicate),
          hn::Sub(cycle, hn::ShiftLeftSame(round, shift))};
}

/// The part that most policies share (fill-inl.h).
struct RoundRobinPoints {
  static LANELIGHT_INLINE GroupIndex Group(const SamplerParameters& points, VU sample) {
    return GroupRoundRobin(points, sample);
  }
};

/// The two samples of pair k, which is observation k, draw unpaired numbers from the same
/// randomisation: sample 2 k + e with k = 4 t + r becomes 4 (2 t + e) + r.
LANELIGHT_INLINE VU UnpairedSample(VU sample) {
  const VU cycle = hn::ShiftLeft<3>(hn::ShiftRight<3>(sample));
  const VU of_pair = hn::ShiftLeft<2>(hn::And(sample, SplatU(1)));
  const VU replicate = hn::And(hn::ShiftRight<1>(sample), SplatU(kReplicates - 1));
  return hn::Or(hn::Or(cycle, of_pair), replicate);
}

/// `count` equal parts of a whole: floor((2^64 - 1) / count) = whole 2^32 + part.
struct Strata {
  uint32_t whole = 0xffffffffu, part = 0xffffffffu;
};
constexpr Strata MakeStrata(uint64_t count) {
  const uint64_t width = ~uint64_t{0} / count;
  return {static_cast<uint32_t>(width >> 32), static_cast<uint32_t>(width)};
}

/// floor(a b / 2^32).
LANELIGHT_INLINE VU MulHigh32(VU a, VU b) {
  const DU du;
  const hn::Repartition<uint64_t, DU> d64;
  const auto odd = [&](VU v) HWY_ATTR {
    return hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(d64, v)));
  };
  const auto even_high = hn::ShiftRight<32>(hn::MulEven(a, b));
  const auto odd_high = hn::MulEven(odd(a), odd(b));
  return hn::OddEven(hn::BitCast(du, odd_high), hn::BitCast(du, even_high));
}

/// i times the fraction (whole 2^32 + part) / 2^64, modulo 1: in 2^-32, rounded down.
LANELIGHT_INLINE VU TimesFraction(VU i, uint32_t whole, uint32_t part) {
  return hn::Add(hn::Mul(i, SplatU(whole)), MulHigh32(i, SplatU(part)));
}

/// (stratum + random / 2^32) / count in 2^-32: off by three units at most, and to
/// smaller values only, so never 1.
LANELIGHT_INLINE VU InStratum(const Strata& strata, VU stratum, VU random) {
  return hn::Add(TimesFraction(stratum, strata.whole, strata.part),
                 MulHigh32(random, SplatU(strata.whole)));
}

// Random permutations of [0, 2^m), one per key, without tables: swap-or-not rounds. Round
// r pairs each x with K_r - x modulo 2^m, and swaps the two or not, as a hash of the
// larger says.
//   uniform   tests/kernels/samplers/permute_test.cc bounds the bias of ten rounds on
//             images, pairs and, for few elements, whole permutations
//   cost      ten rounds of three multiplications and twelve cheap instructions,
//             whatever n
// Source: Hoang, Morris and Rogaway 2012, "An Enciphering Scheme Based on a Card
// Shuffle".
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
  return {log, hn::Sub(power, SplatU(1)), first, hn::Sub(i, first)};
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
