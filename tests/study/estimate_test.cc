// The error estimate is right on average, and its interval covers the truth as often as
// it says, on simulated images whose true error is known.
#include "src/study/estimate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace lanelight {
namespace {

constexpr int kGroups = 64;

// A film of independent pixels: pixel means and standard deviations vary over the image.
struct SimulatedImage {
  int width = 40, height = 28;
  double Mean(int x, int y) const { return 0.05 + 0.02 * x + 0.01 * y; }
  double Deviation(int x, int y) const { return 0.3 * Mean(x, y) * (1 + (x + y) % 3); }

  // Expected value of the estimated relative error: the variance is estimated without
  // bias, and the mean that divides it scatters by little.
  double TrueRmse() const {
    double sum = 0;
    ForEach([&](int x, int y) { sum += std::pow(Deviation(x, y), 2) / kGroups; });
    return std::sqrt(sum / (width * height));
  }
  double TrueRelmse() const {
    double sum = 0;
    ForEach([&](int x, int y) {
      sum += std::pow(Deviation(x, y), 2) / kGroups /
             (std::pow(Mean(x, y), 2) + kRelativeEpsilon);
    });
    return sum / (width * height);
  }
  void ForEach(const std::function<void(int, int)>& body) const {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) body(x, y);
    }
  }

  bool skewed = false;  // exponential instead of normal samples

  // One render: `spread` scales the variances that the pixels claim (1 = honest).
  ErrorEstimate Render(std::mt19937_64& random, double spread = 1) const {
    std::normal_distribution<double> normal;
    std::exponential_distribution<double> exponential;
    const auto noise = [&] { return skewed ? exponential(random) - 1 : normal(random); };
    return EstimateError(width, height, [&](int x, int y) {
      PixelEstimate p;
      p.known = true;
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (int g = 0; g < kGroups; ++g) {
          const double v = Mean(x, y) + Deviation(x, y) * noise();
          sum += v;
          squares += v * v;
        }
        p.mean[c] = sum / kGroups;
        p.variance[c] =
            spread * (squares / kGroups - p.mean[c] * p.mean[c]) / (kGroups - 1);
      }
      return p;
    });
  }
};

// Shares of `trials` whose intervals contain the truth.
struct Coverage {
  double rmse = 0, relmse = 0;
};

Coverage MeasureCoverage(const SimulatedImage& image, int trials, double spread = 1) {
  std::mt19937_64 random(7);
  Coverage covered;
  for (int i = 0; i < trials; ++i) {
    const ErrorEstimate e = image.Render(random, spread);
    const double rmse = image.TrueRmse(), relmse = image.TrueRelmse();
    covered.rmse += (e.rmse.low <= rmse && rmse <= e.rmse.high) / double(trials);
    covered.relmse +=
        (e.relmse.low <= relmse && relmse <= e.relmse.high) / double(trials);
  }
  return covered;
}

}  // namespace

TEST_CASE("estimated errors equal the true ones on average", "[study]") {
  for (bool skewed : {false, true}) {
    SimulatedImage image;
    image.skewed = skewed;
    std::mt19937_64 random(1);
    double mse = 0, relmse = 0;
    constexpr int kTrials = 20;
    for (int i = 0; i < kTrials; ++i) {
      const ErrorEstimate e = image.Render(random);
      REQUIRE(e.available);
      mse += e.rmse.value * e.rmse.value / kTrials;
      relmse += e.relmse.value / kTrials;
    }
    // 20 renders of 1120 pixels x 3 channels of 64 groups scatter by 0.15 % (normal).
    CHECK(std::sqrt(mse) == Approx(image.TrueRmse()).epsilon(0.01));
    // The largest g is 0.81 / 64: a bias of up to 3 g = 3.8 % in those pixels.
    CHECK(relmse == Approx(image.TrueRelmse()).epsilon(0.03));
  }
}

TEST_CASE("95 % intervals cover the true error", "[study]") {
  for (bool skewed : {false, true}) {
    SimulatedImage image;
    image.skewed = skewed;
    // The tiles differ systematically, which only widens the interval: coverage is at
    // least nominal. 40 trials at a coverage of 0.95 stay above 0.8 with probability
    // 0.999.
    const Coverage honest = MeasureCoverage(image, 25);
    CHECK(honest.rmse >= 0.8);
    CHECK(honest.relmse >= 0.8);
  }
}

TEST_CASE("variances that are wrong by a factor of two are not covered", "[study]") {
  SimulatedImage image;
  image.width = image.height = 64;
  for (double spread : {0.5, 2.0}) {
    const Coverage wrong = MeasureCoverage(image, 3, spread);
    CHECK(wrong.rmse < 0.5);
    CHECK(wrong.relmse < 0.5);
  }
}

TEST_CASE("the interval of identically distributed tiles covers at its nominal rate",
          "[study]") {
  // Constant image: every tile has the same expectation, so 0.95 is exact up to the
  // skewness of a sum of 64 * 3 scaled chi-squares.
  constexpr int kTrials = 400;
  std::mt19937_64 random(3);
  std::chi_squared_distribution<double> chi2(kGroups - 1);
  int covered = 0;
  for (int i = 0; i < kTrials; ++i) {
    const ErrorEstimate e = EstimateError(32, 32, [&](int, int) {
      PixelEstimate p{true, {1, 1, 1}, {}};
      for (int c = 0; c < 3; ++c) p.variance[c] = chi2(random) / (kGroups - 1);
      return p;
    });
    const double truth = 1 / (1 + kRelativeEpsilon);
    covered += e.relmse.low <= truth && truth <= e.relmse.high;
  }
  // Binomial(400, 0.95): 380 +- 4.4; five deviations.
  CHECK(covered >= 358);
  CHECK(covered <= 400 - 1);
}

TEST_CASE("pixels without a variance are left out", "[study]") {
  const ErrorEstimate none =
      EstimateError(8, 8, [](int, int) { return PixelEstimate{}; });
  CHECK_FALSE(none.available);
  CHECK_FALSE(none.has_interval);
  const ErrorEstimate one = EstimateError(8, 8, [](int x, int y) {
    return x == 3 && y == 2 ? PixelEstimate{true, {1, 1, 1}, {4, 4, 4}} : PixelEstimate{};
  });
  CHECK(one.available);
  CHECK_FALSE(one.has_interval);
  CHECK(one.pixels == 1);
  CHECK(one.rmse.value == Approx(2));
  CHECK(one.relmse.value == Approx(4 / 1.01));
}

TEST_CASE("intervals never go below zero and contain the estimate", "[study]") {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> heavy(0, 3);
  for (int i = 0; i < 20; ++i) {
    const ErrorEstimate e = EstimateError(17, 9, [&](int, int) {
      const double v = heavy(random);
      return PixelEstimate{true, {0, 0, 0}, {v, v, v}};
    });
    CHECK(e.relmse.low >= 0);
    CHECK(e.relmse.low <= e.relmse.value);
    CHECK(e.relmse.value <= e.relmse.high);
    CHECK(e.tile < 8);
  }
}

TEST_CASE("Student t quantiles agree with the tables", "[study]") {
  // Tables, e.g. Abramowitz and Stegun 26.10.
  CHECK(StudentQuantile975(1) == Approx(12.706).epsilon(1e-3));
  CHECK(StudentQuantile975(5) == Approx(2.5706).epsilon(1e-3));
  CHECK(StudentQuantile975(10) == Approx(2.2281).epsilon(1e-3));
  CHECK(StudentQuantile975(30) == Approx(2.0423).epsilon(1e-3));
  CHECK(StudentQuantile975(1000000) == Approx(1.95996).epsilon(1e-3));
}

}  // namespace lanelight
