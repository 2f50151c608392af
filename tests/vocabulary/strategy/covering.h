// A covering array: few combinations of the choices of several axes in which every two
// choices of different axes meet at least once.
#pragma once

#include <string>
#include <vector>

namespace lanelight::test {

struct Axis {
  std::string key;
  std::vector<std::string> values;
};

/// One choice (index into Axis::values) per axis.
using Combination = std::vector<std::size_t>;

/// At least `min_covered` different combinations that cover all pairs; greedy,
/// deterministic.
std::vector<Combination> CoverPairs(const std::vector<Axis>& axes,
                                    std::size_t min_covered);

/// Pairs of choices that occur in no combination.
std::size_t CountUncoveredPairs(const std::vector<Axis>& axes,
                                const std::vector<Combination>& combinations);

/// "key=value,..." of a combination.
std::string StrategyOf(const std::vector<Axis>& axes, const Combination& combination);

}  // namespace lanelight::test
