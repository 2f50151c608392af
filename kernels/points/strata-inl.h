// Random numbers in one of n equal strata, and fractions of the unit interval, in fixed
// point: 32 bits after the point, of which a float keeps the first 24.
#if defined(LANELIGHT_POINTS_STRATA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_STRATA_INL_H_
#undef LANELIGHT_POINTS_STRATA_INL_H_
#else
#define LANELIGHT_POINTS_STRATA_INL_H_
#endif

#include "kernels/points/group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

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

/// (stratum + random / 2^32) / strata.count in 2^-32: off by three units at most, and to
/// smaller values only, so never 1.
LANELIGHT_INLINE VU InStratum(const Strata& strata, VU stratum, VU random) {
  return hn::Add(TimesFraction(stratum, strata.whole, strata.part),
                 MulHigh32(random, SplatU(strata.whole)));
}

struct QuotientRemainder {
  VU quotient, remainder;
};

/// i / strata.count for i < 2^21: (i + 1/2) / count is at least 1 / (2 count) away from
/// whole numbers, and floats put it off by less than i 2^-22 / count.
LANELIGHT_INLINE QuotientRemainder DivideBy(const Strata& strata, VU i) {
  const DF df;
  const VF middle = hn::Add(hn::ConvertTo(df, hn::BitCast(DI(), i)), hn::Set(df, 0.5f));
  const VF ratio = hn::Mul(middle, hn::Set(df, 1.0f / static_cast<float>(strata.count)));
  const VU quotient = hn::BitCast(DU(), hn::ConvertTo(DI(), ratio));
  return {quotient, hn::Sub(i, hn::Mul(quotient, SplatU(strata.count)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
