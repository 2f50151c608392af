// Holm's procedure: its own example, and the family-wise error by simulation.
#include "src/base/stat/hypothesis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/base/stat/simulate.h"

namespace lanelight::stat {

TEST_CASE("Holm's procedure steps down", "[stat]") {
  using Indices = std::vector<std::size_t>;
  CHECK(HolmRejections(std::vector{0.01, 0.04, 0.03, 0.005}, 0.05) == Indices{0, 3});
  CHECK(HolmRejections(std::vector{0.02, 0.001, 0.024}, 0.05) == Indices{0, 1, 2});
  // Stops at the first that is kept, though a later one is below its own level.
  CHECK(HolmRejections(std::vector{0.03, 0.049}, 0.05).empty());
  CHECK(HolmRejections(std::vector{NAN, 1e-9}, 0.05) == Indices{1});
  CHECK(HolmRejections({}, 0.05).empty());
}

TEST_CASE("Holm's procedure keeps the family-wise error and has more power", "[stat]") {
  // Six true hypotheses beside four that are false.
  const int trials = 20000;
  int false_rejections = 0, uncorrected = 0, found = 0, bonferroni = 0;
  reference::Random random(1);
  for (int t = 0; t < trials; ++t) {
    std::vector<double> p(10);
    for (double& v : p) v = random.Uniform();
    bool any = false;
    for (std::size_t i = 0; i < 6; ++i) any |= p[i] < 0.05;
    uncorrected += any;
    for (std::size_t i = 6; i < 10; ++i) p[i] *= 0.01;
    for (std::size_t i = 6; i < 10; ++i) bonferroni += p[i] <= 0.005;
    const auto rejected = HolmRejections(p, 0.05);
    false_rejections += !rejected.empty() && rejected.front() < 6;
    for (std::size_t i : rejected) found += i >= 6;
  }
  const double maximum = 0.05 + FiveSigma(0.05, trials);
  CHECK(false_rejections < maximum * trials);
  CHECK(uncorrected > maximum * trials);
  CHECK(found > bonferroni);
}

}  // namespace lanelight::stat
