// The tests are tested: false-alarm rates by simulation, planted biases that must be
// found.
#include "src/base/stat/hypothesis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "tests/base/stat/compare_means.h"
#include "tests/base/stat/kolmogorov.h"
#include "tests/reference/random.h"

namespace lanelight::stat {
namespace {

using reference::Random;

// Mean of n exponential observations of mean `mean`: skewed, as radiance samples are.
MeanEstimate SimulateMean(Random& random, double mean, int n) {
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double value = -mean * std::log(random.Uniform());
    sum += value;
    squares += value * value;
  }
  const double m = sum / n;
  return {m, (squares / n - m * m) / (n - 1), n - 1.0};
}

ImageEstimate SimulateImage(Random& random, double mean, int size, int n) {
  ImageEstimate image = {size, size, static_cast<double>(n), {}, {}};
  for (int i = 0; i < size * size; ++i) {
    Rgb m, v;
    for (int c = 0; c < 3; ++c) {
      const MeanEstimate e = SimulateMean(random, mean * (1 + c), n);
      m[c] = e.mean;
      v[c] = e.variance;
    }
    image.mean.push_back(m);
    image.variance.push_back(v);
  }
  return image;
}

}  // namespace

TEST_CASE("Welch's test has uniform p-values under equal means", "[stat]") {
  Random random(11);
  std::vector<double> p;
  for (int i = 0; i < 4000; ++i) {
    // Unequal sizes, equal means.
    p.push_back(WelchPValue(SimulateMean(random, 2, 60), SimulateMean(random, 2, 150)));
  }
  CHECK(KsUniformPValue(p) > 1e-3);
  // A shift of a third of a standard error must spoil the uniformity.
  for (double& value : p) {
    MeanEstimate a = SimulateMean(random, 2, 60), b = SimulateMean(random, 2, 150);
    a.mean += 0.5 * std::sqrt(a.variance + b.variance);
    value = WelchPValue(a, b);
  }
  CHECK(KsUniformPValue(p) < 1e-6);
}

TEST_CASE("Welch's test handles constants, tolerance and invalid values", "[stat]") {
  const MeanEstimate one = {1, 0, 0}, near = {1.0001, 0, 0}, bad = {NAN, 0, 0};
  CHECK(WelchPValue(one, one) == 1);
  CHECK(WelchPValue(one, near) == 0);
  CHECK(WelchPValue(one, near, 1e-3) == 1);
  CHECK(WelchPValue(one, bad) == 0);
  // t = 2 with 10 degrees of freedom.
  CHECK(WelchPValue({3, 1, 10}, one) == Approx(StudentTwoSided(2, 10)));
}

TEST_CASE("averages of estimates carry variance and degrees of freedom", "[stat]") {
  const MeanEstimate mean = Average({{1, 4, 9}, {3, 4, 9}});
  CHECK(mean.mean == 2);
  CHECK(mean.variance == 2);
  CHECK(mean.dof == Approx(18));
}

TEST_CASE("Sidak's level gives the family-wise error rate", "[stat]") {
  CHECK(1 - std::pow(1 - SidakLevel(0.01, 50), 50) == Approx(0.01));
  CHECK(SidakLevel(1e-6, 1000) == Approx(1e-9).epsilon(1e-5));
  CHECK(SidakLevel(0.05, 1) == Approx(0.05));
}

TEST_CASE("the image comparison keeps its false-alarm rate", "[stat]") {
  Random random(5);
  const int trials = 300;
  int alarms = 0;
  for (int i = 0; i < trials; ++i) {
    const ImageEstimate a = SimulateImage(random, 1, 8, 32);
    const ImageEstimate b = SimulateImage(random, 1, 8, 64);
    alarms += !CompareMeans(a, b, {4, 0.05}).same;
  }
  // Binomial(300, 0.05): mean 15, standard deviation 3.8; 34 is five of them above.
  CHECK(alarms < 34);
  CHECK(alarms > 1);
}

TEST_CASE("the image comparison finds a bias of 1 % and of one tile", "[stat]") {
  Random random(6);
  const ImageEstimate a = SimulateImage(random, 1, 16, 4096);
  const ImageEstimate b = SimulateImage(random, 1, 16, 4096);
  const ImageTestResult same = CompareMeans(a, b);
  INFO(same.ToString());
  CHECK(same.same);
  CHECK(same.uniformity_p > 1e-3);
  // About 1 % is what it says it can find at this number of samples, and it does.
  CHECK(same.detectable_bias < 0.0105);
  ImageEstimate biased = b;
  for (Rgb& m : biased.mean) m *= 1.01;
  CHECK_FALSE(CompareMeans(a, biased).same);
  ImageEstimate local = b;
  for (int y = 4; y < 8; ++y) {
    for (int x = 8; x < 12; ++x) local.mean[y * 16 + x] *= 1.1;
  }
  const ImageTestResult found = CompareMeans(a, local);
  CHECK_FALSE(found.same);
  CHECK(found.worst.find("[8,12)x[4,8)") == 0);
  // ... and tolerated where that is asked for.
  CHECK(CompareMeans(a, biased, {4, 1e-6, 0.02}).same);
}

TEST_CASE("the stated detectable bias is detected with probability 0.95", "[stat]") {
  Random random(7);
  int found = 0;
  const int trials = 200;
  const double bias = CompareMeans(SimulateImage(random, 1, 8, 128),
                                   SimulateImage(random, 1, 8, 128), {4, 1e-3})
                          .detectable_bias;
  for (int i = 0; i < trials; ++i) {
    const ImageEstimate a = SimulateImage(random, 1, 8, 128);
    const ImageEstimate b = SimulateImage(random, 1 + bias, 8, 128);
    found += !CompareMeans(a, b, {4, 1e-3}).same;
  }
  CHECK(found > 0.9 * trials);
}

}  // namespace lanelight::stat
