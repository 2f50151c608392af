// The reference tracer's own random numbers: SplitMix64 seeds xoshiro256** (Blackman and
// Vigna, "Scrambled linear pseudorandom number generators", ACM TOMS 2021). Shares
// nothing with the samplers of the kernels.
#pragma once

#include <array>
#include <cstdint>

namespace lanelight::reference {

/// One step of SplitMix64 (Steele, Lea and Flood 2014): advances `state`, returns a mix.
inline std::uint64_t SplitMix64(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

class Random {
 public:
  /// Streams of different (seed, stream) pairs are unrelated.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t mix = stream;
    std::uint64_t state = seed ^ SplitMix64(mix);
    for (std::uint64_t& word : s_) word = SplitMix64(state);
  }

  /// 64 uniform bits.
  std::uint64_t Bits() {
    const std::uint64_t result = Rotate(s_[1] * 5, 7) * 9;
    const std::uint64_t t = s_[1] << 17;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= t;
    s_[3] = Rotate(s_[3], 45);
    return result;
  }

  /// Uniform on the open interval (0, 1): odd multiples of 2^-54.
  double Uniform() { return (static_cast<double>(Bits() >> 11) + 0.5) * 0x1p-53; }

 private:
  static std::uint64_t Rotate(std::uint64_t x, int k) {
    return (x << k) | (x >> (64 - k));
  }
  std::array<std::uint64_t, 4> s_;
};

}  // namespace lanelight::reference
