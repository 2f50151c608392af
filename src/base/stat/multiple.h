// Many tests at once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lanelight::stat {

/// Holm's (1979) step-down procedure: which hypotheses are rejected, as ascending
/// indices. Any false rejection happens with probability at most `family` in (0, 1),
/// however the tests depend on each other. A p-value of NaN is never rejected.
std::vector<std::size_t> HolmRejections(std::span<const double> p, double family);

}  // namespace lanelight::stat
