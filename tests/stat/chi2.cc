#include "tests/stat/chi2.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Lower regularised incomplete gamma function by its power series; for x < a + 1.
double GammaSeries(double a, double x) {
  double term = 1 / a, sum = term;
  for (double n = a + 1; term > sum * 1e-17; n += 1) sum += term *= x / n;
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

// Upper one by the continued fraction 1/(x+1-a- 1(1-a)/(x+3-a- 2(2-a)/(x+5-a- ...))),
// evaluated from the tail; for x >= a + 1.
double GammaFraction(double a, double x) {
  double tail = 0;
  for (int n = 2000; n >= 1; --n) tail = n * (n - a) / (x + 2 * n + 1 - a - tail);
  return std::exp(a * std::log(x) - x - std::lgamma(a)) / (x + 1 - a - tail);
}

}  // namespace

double ChiSquareTail(double x, double degrees) {
  if (x <= 0) return 1;
  const double a = degrees / 2, y = x / 2;
  return y < a + 1 ? 1 - GammaSeries(a, y) : GammaFraction(a, y);
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
  if (result.degrees > 0) result.p = ChiSquareTail(result.statistic, result.degrees);
  return result;
}

double SidakLevel(double family, int tests) {
  return -std::expm1(std::log1p(-family) / tests);
}

}  // namespace lanelight
