// Samples that had to be mended.
#pragma once

#include <cstdint>

namespace lanelight {

/// Samples that were not finite, or negative where they must not be. Each is replaced by
/// zero and counted.
struct Health {
  std::uint64_t nan = 0, infinite = 0, negative = 0;
  std::uint64_t Total() const { return nan + infinite + negative; }
};

}  // namespace lanelight
