// Counter-based random numbers: four 32-bit words from four 32-bit words, so that every
// number is a pure function of (seed, pixel, sample, dimension).
#ifndef LANELIGHT_SIMD_RNG_INL_H_
#define LANELIGHT_SIMD_RNG_INL_H_

#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

struct U4 {
  VU x, y, z, w;
};

HWY_INLINE VU SplatU(uint32_t v) { return hn::Set(DU(), v); }
HWY_INLINE VU AsUnsigned(VI v) { return hn::BitCast(DU(), v); }

/// PCG-4D (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"): a permutation
/// of 128-bit words; passes the statistical tests named in the paper.
LANELIGHT_INLINE U4 Pcg4d(U4 v) {
  const VU a = SplatU(1664525u), c = SplatU(1013904223u);
  const auto step = [&](VU s) HWY_ATTR { return hn::Add(hn::Mul(s, a), c); };
  const auto mix = [](U4 s) HWY_ATTR {
    s.x = hn::Add(s.x, hn::Mul(s.y, s.w));
    s.y = hn::Add(s.y, hn::Mul(s.z, s.x));
    s.z = hn::Add(s.z, hn::Mul(s.x, s.y));
    s.w = hn::Add(s.w, hn::Mul(s.y, s.z));
    return s;
  };
  const auto fold = [](VU s) HWY_ATTR { return hn::Xor(s, hn::ShiftRight<16>(s)); };
  v = mix({step(v.x), step(v.y), step(v.z), step(v.w)});
  return mix({fold(v.x), fold(v.y), fold(v.z), fold(v.w)});
}

/// Returns a uniform number in [0, 1): the top 24 bits, exact in float.
LANELIGHT_INLINE VF ToUnit(VU bits) {
  const VI top = hn::BitCast(DI(), hn::ShiftRight<8>(bits));
  return hn::Mul(hn::ConvertTo(DF(), top), hn::Set(DF(), 0x1p-24f));
}

/// Bytes of each word reversed, then the bits of each byte by its halves.
LANELIGHT_INLINE VU ReverseBits32(VU v) {
  const DU du;
  const hn::Repartition<uint8_t, DU> d8;
  HWY_ALIGN static constexpr uint8_t kBytes[16] = {3,  2,  1, 0, 7,  6,  5,  4,
                                                   11, 10, 9, 8, 15, 14, 13, 12};
  HWY_ALIGN static constexpr uint8_t kBits[16] = {0, 8, 4, 12, 2, 10, 6, 14,
                                                  1, 9, 5, 13, 3, 11, 7, 15};
  const auto bits = hn::LoadDup128(d8, kBits);
  const auto reversed = [&](VU halves) HWY_ATTR {
    return hn::BitCast(du, hn::TableLookupBytes(bits, hn::BitCast(d8, halves)));
  };
  const VU half = SplatU(0x0f0f0f0fu);
  v = hn::BitCast(du,
                  hn::TableLookupBytes(hn::BitCast(d8, v), hn::LoadDup128(d8, kBytes)));
  return hn::Or(hn::ShiftLeft<4>(reversed(hn::And(v, half))),
                reversed(hn::And(hn::ShiftRight<4>(v), half)));
}

LANELIGHT_END_KERNELS

#endif
