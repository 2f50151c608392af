// Which of two is ahead.
#include "src/live/score.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "src/estimate/estimate.h"

namespace lanelight::live {
namespace {

Look LookOf(Interval relmse, std::uint64_t spp, double seconds) {
  Look look;
  look.spp = spp;
  look.seconds = seconds;
  look.error.available = true;
  look.error.relmse = relmse;
  return look;
}

}  // namespace

TEST_CASE("the ratio is of errors times what they cost", "[live]") {
  const Look a = LookOf({0.4, 0.2, 0.8}, 10, 3), b = LookOf({0.1, 0.1, 0.1}, 5, 6);
  const Ratio time = EfficiencyOf(a, b, Pace::kTime);
  REQUIRE(time.available);
  CHECK(time.interval.value == Approx(0.4 * 3 / (0.1 * 6)));
  // b is exact: the ends are a's.
  CHECK(time.interval.low == Approx(time.interval.value / 2));
  CHECK(time.interval.high == Approx(time.interval.value * 2));
  CHECK(EfficiencyOf(a, b, Pace::kSamples).interval.value ==
        Approx(0.4 * 10 / (0.1 * 5)));
}

TEST_CASE("the ends of a ratio join those of both", "[live]") {
  const Look a = LookOf({1, 0.5, 3}, 1, 1), b = LookOf({1, 0.25, 2}, 1, 1);
  const Ratio ratio = EfficiencyOf(a, b, Pace::kTime);
  CHECK(ratio.interval.low ==
        Approx(std::exp(-std::hypot(std::log(2.0), std::log(2.0)))));
  CHECK(ratio.interval.high ==
        Approx(std::exp(std::hypot(std::log(3.0), std::log(4.0)))));
}

TEST_CASE("an end that is not known is open, with the reason", "[live]") {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Look a = LookOf({1, 0.5, kInfinite}, 1, 1);
  a.error.why = "few pixels carry it";
  const Look b = LookOf({1, 0.5, 2}, 1, 1);
  const Ratio up = EfficiencyOf(a, b, Pace::kTime),
              down = EfficiencyOf(b, a, Pace::kTime);
  CHECK(up.interval.high == kInfinite);
  CHECK(up.interval.low > 0);
  CHECK(up.why == "of A: few pixels carry it");
  CHECK(down.interval.low == 0);
  CHECK(std::isfinite(down.interval.high));
  CHECK(down.why == "of B: few pixels carry it");
  CHECK_FALSE(EfficiencyOf(LookOf({0, 0, 0}, 1, 1), b, Pace::kTime).available);
}

// 400 pairs of images of independent normal noise whose errors differ threefold: the
// 95 % interval misses in 20 of them on average, and in more than 38 with a probability
// of 1e-4 (binomial).
TEST_CASE("the interval of a ratio holds the true one", "[live]") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto look = [&](double deviation) {
    constexpr int kSide = 32, kObservations = 4;
    std::vector<PixelEstimate> pixels(kSide * kSide);
    for (PixelEstimate& p : pixels) {
      p.known = true;
      p.freedom = kObservations - 1;
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (int i = 0; i < kObservations; ++i) {
          const double x = 5 + deviation * normal(random);
          sum += x, squares += x * x;
        }
        p.mean[c] = sum / kObservations;
        p.variance[c] =
            (squares / kObservations - p.mean[c] * p.mean[c]) / (kObservations - 1);
      }
    }
    Look out = LookOf({}, 1, 1);
    out.error = EstimateError({0, 0, kSide, kSide}, [&](int x, int y) {
      return pixels[static_cast<std::size_t>(y * kSide + x)];
    });
    return out;
  };
  int missed = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Look a = look(0.3), b = look(0.1);
    missed += !EfficiencyOf(a, b, Pace::kTime).interval.Contains(9);
  }
  CHECK(missed <= 38);
}

}  // namespace lanelight::live
