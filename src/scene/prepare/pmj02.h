// Progressive multi-jittered (0,2) sequences: of every prefix of 2^k points, each
// elementary interval of base 2 and area 2^-k (2^-j wide, 2^(j-k) high) holds exactly
// one. Property: Christensen, Kensler and Kilpatrick 2018.
#pragma once

#include <cstdint>
#include <span>

namespace lanelight {

/// Points of one stored sequence.
inline constexpr std::uint32_t kPmj02SequenceLength = 1024;
/// Stored sequences: points of 2^32 u0, 2^32 u1, one sequence after the other.
inline constexpr std::uint32_t kPmj02Sequences = 8;

/// The table, built at the first call (about a millisecond) from a fixed seed.
std::span<const std::uint32_t> Pmj02Table();

/// Fills `points` (u0, u1 of point 0, of point 1, ...; a power of two of points) with one
/// sequence.
void MakePmj02(std::uint64_t seed, std::span<std::uint32_t> points);

}  // namespace lanelight
