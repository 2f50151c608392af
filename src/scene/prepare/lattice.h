// The generator of points=lattice.
#pragma once

#include <cstdint>

namespace lanelight {

/// A z such that the 2^m points (i / 2^m, frac(i z / 2^m)) integrate smooth functions
/// well for all m up to 24. A search over forty million numbers minimised the largest
/// ratio, over m, of the leading error terms to those of the best generator of 2^m: below
/// 3 (tests/scene/prepare/lattice_test.cc).
inline constexpr std::uint32_t kLatticeGenerator = 0xba1a6b63u;

}  // namespace lanelight
