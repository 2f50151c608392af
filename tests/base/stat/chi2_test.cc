#include "tests/base/stat/chi2.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace lanelight::stat {

TEST_CASE("chi-square test accepts the true density and rejects a wrong density",
          "[stat]") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> u;
  std::vector<double> counts(20, 0), right(20, 500), wrong(20, 500);
  for (int i = 0; i < 10000; ++i) counts[static_cast<int>(20 * u(engine))] += 1;
  wrong[3] *= 1.3;
  wrong[4] *= 0.7;
  CHECK(ChiSquareTest(counts, right).p > 1e-4);
  CHECK(ChiSquareTest(counts, wrong).p < 1e-6);
}

TEST_CASE("a sample where the density is zero is rejected", "[stat]") {
  CHECK(ChiSquareTest({99, 100, 1}, {100, 100, 0}).p == 0);
  CHECK(ChiSquareTest({100, 100, 0}, {100, 100, 0}).p > 0.9);
}

}  // namespace lanelight::stat
