// Random numbers in one of n equal strata, and fractions of the unit interval, in fixed
// point: 32 bits after the point, of which a float keeps the first 24.
#ifndef LANELIGHT_POINTS_STRATA_INL_H_
#define LANELIGHT_POINTS_STRATA_INL_H_

#include "kernels/points/group-inl.h"

LANELIGHT_BEGIN_KERNELS

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

/// (stratum + random / 2^32) / 2^log in 2^-32; stratum < 2^log, log < 32.
LANELIGHT_INLINE VU InBinaryStratum(VU stratum, VU log, VU random) {
  const VU up = hn::Sub(SplatU(31), log);  // two shifts: one by 32 has no meaning
  return hn::Or(hn::Shl(hn::ShiftLeft<1>(stratum), up), hn::Shr(random, log));
}

LANELIGHT_END_KERNELS

#endif
