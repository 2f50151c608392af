#include "tests/base/stat/chi2.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>

#include "src/base/core/check.h"

namespace lanelight::stat {

double ChiSquareSurvival(double x, double nu) {
  return x <= 0 ? 1 : boost::math::gamma_q(nu / 2, x / 2);
}

double ChiSquareQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p < 1 && nu > 0);
  // The smaller of the two tails is the one known to full relative precision.
  return 2 * (p < 0.5 ? boost::math::gamma_p_inv(nu / 2, p)
                      : boost::math::gamma_q_inv(nu / 2, 1 - p));
}

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
