// The random numbers of a path that control=regression keeps: codes of 32 bits, four per
// sample.
//   a pair     bit 31 is set; above 15 bits of the second number 16 of the first one. A
//              code stands for the middle of its cell, so that polynomials of degree 2
//              keep their mean up to 1e-9
//   choices    of two events, the first in the lower 16 bits: whether the first lobe was
//              chosen, below 15 bits of its probability p, to which that is exact. 0 =
//              none
#pragma once

#include <cstdint>

namespace lanelight {

inline constexpr int kFirstNumbers = 4;
inline constexpr int kBitsOfFirst = 16, kBitsOfSecond = 15, kBitsOfProbability = 15;
inline constexpr std::uint32_t kHasPair = 0x80000000u;

/// Numbers in [0, 1).
inline std::uint32_t PairCode(float first, float second) {
  return kHasPair |
         static_cast<std::uint32_t>(first * (1 << kBitsOfFirst)) << kBitsOfSecond |
         static_cast<std::uint32_t>(second * (1 << kBitsOfSecond));
}

/// Encodes one event: the number u chooses the first lobe, of probability p < 1, if u <
/// p.
inline std::uint32_t ChoiceCode(float u, float p) {
  constexpr float kScale = 1 << kBitsOfProbability;
  const auto code = static_cast<std::uint32_t>(p * kScale);
  return code << 1 | (u * kScale < static_cast<float>(code) ? 1 : 0);
}

}  // namespace lanelight
