// Who departs from whom, by simulation: no false alarms, also where variances lie, and
// planted departures are found.
#include "src/base/stat/hypothesis.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/base/stat/simulate.h"

namespace lanelight::stat {
namespace {

using reference::Random;

// A measurement of 0 with this deviation, its variance known from 40 values.
MeanEstimate Measure(Random& random, double deviation) {
  double squares = 0;
  for (int i = 0; i < 40; ++i) squares += std::pow(Normal(random), 2) / 40;
  return {deviation * Normal(random), deviation * deviation * squares, 40};
}

// Returns how often the first of n departs from the others at the level 0.01.
// `understated` is the factor by which all variances are understated.
double Rejected(int n, double bias, double understated, int trials) {
  return Share(trials, 3, [&](Random& random) {
    std::vector<MeanEstimate> others;
    for (int i = 1; i < n; ++i) {
      others.push_back(Measure(random, 0.2 + 0.3 * i));
      others.back().variance /= understated;
    }
    MeanEstimate one = Measure(random, 0.5);
    one.variance /= understated;
    one.mean += bias;
    return DeparturePValue(one, others, 1e-12) < 0.01;
  });
}

}  // namespace

TEST_CASE("measurements of the same quantity agree", "[stat]") {
  const int trials = 4000;
  // Five standard deviations of a proportion of 0.01: a false alarm in two million.
  const double maximum = 0.01 + FiveSigma(0.01, trials);
  for (int n : {2, 3, 8, 25}) {
    INFO(n);
    CHECK(Rejected(n, 0, 1, trials) < maximum);
  }
}

TEST_CASE("underestimated variances do not flag an outlier", "[stat]") {
  const int trials = 2000;
  // Birge's ratio of many finds out; planted: without it, most would be rejected.
  CHECK(Rejected(25, 0, 100, trials) < 0.05);
  int naive = 0;
  Random random(4);
  for (int t = 0; t < trials; ++t) {
    MeanEstimate a = Measure(random, 0.5), b = Measure(random, 1);
    a.variance /= 100, b.variance /= 100;
    naive += WelchPValue(a, b) < 0.01;
  }
  CHECK(naive > trials / 2);
}

TEST_CASE("a single outlier is found", "[stat]") {
  CHECK(Rejected(3, 5, 1, 300) > 0.9);
  CHECK(Rejected(25, 3, 1, 300) > 0.9);
}

TEST_CASE("a consensus is the weighted mean, with its uncertainty increased by scatter",
          "[stat]") {
  const std::vector<MeanEstimate> two = {{1, 1, 10}, {4, 0.5, 10}};
  const Consensus c = ConsensusOf(two, 1e-9);
  CHECK(c.estimate.mean == Approx(3));  // weights 1 and 2
  CHECK(c.birge == Approx(6));          // 1 x 2^2 + 2 x 1^2
  CHECK(c.estimate.variance == Approx(6.0 / 3));
  const std::vector<MeanEstimate> exact = {{2, 0, 1}, {2, 0, 1}};
  CHECK(ConsensusOf(exact, 1e-9).birge == 1);
  CHECK(DeparturePValue({2, 0, 1}, exact, 1e-9) == 1);
  CHECK(DeparturePValue({3, 0, 1}, exact, 1e-9) < 1e-6);
  CHECK(DeparturePValue({3, 0, 1}, {}, 1e-9) == 1);
}

}  // namespace lanelight::stat
