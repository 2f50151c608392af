// What a generator of rank-1 lattices in two dimensions is worth, and the best ones: the
// measure of kLatticeGenerator (src/scene/prepare/lattice.h).
#pragma once

#include <cstdint>

namespace lanelight {

/// z such that the points (i / n, frac(i z / n)), i < n, integrate smooth functions well:
/// coprime to n, and the least LatticeError among some thousand numbers around n over the
/// golden ratio. 1 <= n < 2^31.
std::uint32_t LatticeGenerator(std::uint32_t n);

/// Sum of 1 / (h k)^2 over the shortest pairs h, k > 0 with h = +-k z modulo n, those of
/// the convergents of z / n: the leading terms of the error P_2 (Sloan and Joe 1994) of
/// the lattice. z coprime to n.
double LatticeError(std::uint32_t n, std::uint32_t z);

}  // namespace lanelight
