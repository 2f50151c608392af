// The dimensions of a path's random numbers, by name. A number is a pure function of
// (seed, pixel, sample, key); a key is made of dimension, depth and branch.
//
// Every bounce has kDimensionsPerBounce of them, and every purpose a range of its own. A
// new dimension takes a free number and changes no other.
// tests/kernels/samplers/golden_test.cc holds values of each.
#pragma once

#include <cstdint>

namespace lanelight {

/// Each is one point of up to four coordinates. The first depth is also the camera's.
enum class Dimension : std::uint32_t {
  // 0 to 7: the camera
  kFilm = 0,          // 2: position in the pixel
  kLens = 1,          // 2: position on the lens
  kCameraMedium = 2,  // 2: as kMedium, of the camera ray
  kTime = 3,          // 1: when the shutter is open
  kWavelength = 4,    // 1: wavelengths of the path
  // 8 to 15: where a path goes
  kBsdf = 8,  // 2: direction
  kLobe = 9,  // 1: choice of lobe
  // 10: free
  kMedium = 11,  // 2: distance in a medium, choice of channel
  // 16 to 23: light samples
  kLight = 16,   // 2: point on the light
  kSelect = 17,  // 1: choice of light
  // 18: free
  kCandidate = 19,  // 1: choice between light candidates
  // 24 to 31: whether a path goes on
  kRoulette = 24,  // 1: survival, or how many copies
  // 32 to 47: materials; one per level of mixes in mixes
  kMix = 32,  // 1: choice between mixed materials
  // 48 to 63: free
};
inline constexpr std::uint32_t kDimensionsPerBounce = 64;
/// Levels of mixes that have a dimension of their own.
inline constexpr std::uint32_t kMixDimensions = 16;

// Bits of a key: 6 of the dimension, 20 of the depth, the rest of the branch: copies of a
// path that has split draw from dimensions of their own.
inline constexpr int kDepthShift = 6, kBranchShift = 26;
static_assert(kDimensionsPerBounce == 1u << kDepthShift);

// The random numbers of a path that control=regression keeps: codes of 32 bits, four per
// sample.
//   a pair     bit 31 is set; above 15 bits of the second number 16 of the first one. A
//              code stands for the middle of its cell, so that polynomials of degree 2
//              keep their mean up to 1e-9
//   choices    of two events, the first in the lower 16 bits: whether the first lobe was
//              chosen, below 15 bits of its probability p, to which that is exact. 0 =
//              none
inline constexpr int kFirstNumbers = 4;
inline constexpr int kBitsOfFirst = 16, kBitsOfSecond = 15, kBitsOfProbability = 15;
inline constexpr std::uint32_t kHasPair = 0x80000000u;

/// Encodes two numbers in [0, 1).
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
