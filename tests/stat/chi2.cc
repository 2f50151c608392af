#include "tests/stat/chi2.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/core/check.h"
#include "src/stat/distributions.h"

namespace lanelight::stat {

ChiSquareResult ChiSquareTest(const std::vector<double>& observed,
                              const std::vector<double>& expected) {
  LL_CHECK_EQ(observed.size(), expected.size());
  struct Cell {
    double observed, expected;
  };
  std::vector<Cell> cells;
  Cell pool = {0, 0};
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 5) {
      pool.observed += observed[i];
      pool.expected += expected[i];
    } else {
      cells.push_back({observed[i], expected[i]});
    }
  }
  ChiSquareResult result;
  if (pool.expected < 1e-9 && pool.observed > 0) return {HUGE_VAL, 1, 0};
  if (pool.expected >= 5 || cells.empty()) {
    cells.push_back(pool);
  } else {
    auto smallest = std::min_element(cells.begin(), cells.end(), [](Cell a, Cell b) {
      return a.expected < b.expected;
    });
    smallest->observed += pool.observed;
    smallest->expected += pool.expected;
  }
  for (const Cell& c : cells) {
    const double difference = c.observed - c.expected;
    result.statistic += difference * difference / c.expected;
  }
  result.degrees = static_cast<int>(cells.size()) - 1;
  if (result.degrees > 0) result.p = ChiSquareSurvival(result.statistic, result.degrees);
  return result;
}

}  // namespace lanelight::stat
