// Generators of rank-1 lattices in two dimensions.
#pragma once

#include <cstdint>

namespace lanelight {

/// Largest lattice: products of two indices stay below 2^32.
inline constexpr std::uint32_t kMostLattice = 1u << 16;

/// z such that the points (i / n, frac(i z / n)), i < n, are well spread: coprime to n.
/// 1 <= n <= kMostLattice.
std::uint32_t LatticeGenerator(std::uint32_t n);

}  // namespace lanelight
