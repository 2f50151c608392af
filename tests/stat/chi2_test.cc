#include "tests/stat/chi2.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace lanelight {

TEST_CASE("chi-square tail against closed forms", "[stat]") {
  // Even degrees: Q = exp(-x/2) * sum (x/2)^k / k!; one degree: erfc(sqrt(x/2)).
  for (double x : {0.01, 0.5, 1.0, 3.0, 10.0, 40.0, 200.0}) {
    CHECK(ChiSquareTail(x, 1) == Approx(std::erfc(std::sqrt(x / 2))).epsilon(1e-10));
    CHECK(ChiSquareTail(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-10));
    CHECK(ChiSquareTail(x, 4) == Approx(std::exp(-x / 2) * (1 + x / 2)).epsilon(1e-10));
  }
}

TEST_CASE("chi-square test accepts the right density and rejects a wrong one", "[stat]") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> u;
  std::vector<double> counts(20, 0), right(20, 500), wrong(20, 500);
  for (int i = 0; i < 10000; ++i) counts[static_cast<int>(20 * u(engine))] += 1;
  wrong[3] *= 1.3;
  wrong[4] *= 0.7;
  CHECK(ChiSquareTest(counts, right).p > 1e-4);
  CHECK(ChiSquareTest(counts, wrong).p < 1e-6);
}

TEST_CASE("a hit where nothing is expected is rejected", "[stat]") {
  CHECK(ChiSquareTest({99, 100, 1}, {100, 100, 0}).p == 0);
  CHECK(ChiSquareTest({100, 100, 0}, {100, 100, 0}).p > 0.9);
}

TEST_CASE("Sidak level", "[stat]") {
  CHECK(SidakLevel(0.01, 1) == Approx(0.01));
  CHECK(1 - std::pow(1 - SidakLevel(0.01, 50), 50) == Approx(0.01));
}

}  // namespace lanelight
