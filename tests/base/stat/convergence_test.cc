// Orders of convergence and costs of a target: exact on power laws, intervals that hold.
#include "src/base/stat/convergence.h"

#include <catch2/catch.hpp>

#include "tests/base/stat/simulate.h"

namespace lanelight::stat {
namespace {

using reference::Random;

// Errors samples^(2 order), seconds proportional to samples, for 1, 4, 16, ... samples.
// Repetition r scatters by exp(sigma z), z = a common and an independent part.
std::vector<Level> PowerLaw(Random& random, double order, double sigma, double common,
                            std::size_t repetitions) {
  std::vector<Level> levels;
  std::vector<double> shared(repetitions);
  for (double& z : shared) z = Normal(random);
  for (double samples : {1.0, 4.0, 16.0, 64.0}) {
    Level level = {samples, {}, {}};
    for (double z : shared) {
      const double mixed = std::sqrt(common) * z + std::sqrt(1 - common) * Normal(random);
      level.error.push_back(std::pow(samples, 2 * order) * LogNormal(mixed, sigma));
      level.seconds.push_back(0.5 * samples * LogNormal(Normal(random), sigma / 10));
    }
    levels.push_back(level);
  }
  return levels;
}

}  // namespace

TEST_CASE("intervals of fitted convergence orders have the stated coverage", "[stat]") {
  const int trials = 10000;
  for (double order : {-0.5, -1.0}) {
    for (double common : {0.0, 0.9}) {
      for (std::size_t n : {std::size_t{3}, std::size_t{8}}) {
        const auto covers = [&](double slope) {
          return Share(trials, 1, [&](Random& random) {
            return FitOrder(PowerLaw(random, order, 0.2, common, n), 0.95)
                ->Contains(slope);
          });
        };
        INFO("order " << order << ", " << n << " repetitions, common " << common);
        CHECK(std::abs(covers(order) - 0.95) < FiveSigma(0.95, trials));
        // Planted: an order that is wrong by 0.1 is outside nearly always.
        if (n == 8) CHECK(covers(order + 0.1) < 0.05);
      }
    }
  }
}

TEST_CASE("a single fit through all repetitions misjudges its uncertainty", "[stat]") {
  // The wrong twin: residuals of a single regression, which takes errors of different
  // counts for independent. With a common part its interval is far too long.
  const int trials = 2000;
  double fitted = 0, pooled = 0;
  Random random(2);
  for (int t = 0; t < trials; ++t) {
    const auto levels = PowerLaw(random, -0.5, 0.2, 0.9, 6);
    const Interval order = *FitOrder(levels, 0.95);
    fitted += (order.high - order.low) / trials;
    double residual = 0, spread = 0;
    for (const Level& l : levels) {
      for (double e : l.error) {
        const double r = 0.5 * std::log(e) + 0.5 * std::log(l.samples) + 0.01;
        residual += r * r / 22;
        const double x = std::log(l.samples) - std::log(8.0);
        spread += x * x;
      }
    }
    pooled += 2 * 2.07 * std::sqrt(residual / spread) / trials;
  }
  CHECK(fitted < 0.6 * pooled);
}

TEST_CASE("fitted orders are defined for few samples", "[stat]") {
  Random random(3);
  CHECK_FALSE(FitOrder({}, 0.95));
  auto levels = PowerLaw(random, -0.5, 0, 0, 1);
  CHECK(FitOrder(levels, 0.95)->value == Approx(-0.5));
  CHECK_FALSE(FitOrder(levels, 0.95)->HasBounds());
  levels[2].error[0] = 0;  // left out
  CHECK(FitOrder(levels, 0.95)->value == Approx(-0.5));
  levels.resize(1);
  CHECK_FALSE(FitOrder(levels, 0.95));
  const std::vector<Level> black = {{1, {0, 0}, {1, 1}}, {4, {0, 0}, {2, 2}}};
  CHECK_FALSE(FitOrder(black, 0.95));
}

TEST_CASE("the cost of a target is exact on a power law", "[stat]") {
  Random random(4);
  const auto levels = PowerLaw(random, -0.5, 0, 0, 3);  // error 1 / n, n / 2 seconds
  const auto inside = CostToTarget(levels, 0.1, 0.95);
  REQUIRE(inside);
  CHECK(inside->samples.value == Approx(10));
  CHECK(inside->seconds.value == Approx(5));
  CHECK(inside->samples.low == Approx(10));
  CHECK(inside->samples.high == Approx(10));
  CHECK_FALSE(inside->extrapolated);
  for (double target : {1.0, 0.25, 1.0 / 64}) {  // met exactly
    const auto met = CostToTarget(levels, target, 0.95);
    REQUIRE(met);
    CHECK(met->samples.value == Approx(1 / target));
    CHECK_FALSE(met->extrapolated);
  }
  for (double target : {2.0, 1e-3, 1.001 / 64000}) {
    const auto beyond = CostToTarget(levels, target, 0.95);
    REQUIRE(beyond);
    CHECK(beyond->samples.value == Approx(1 / target));
    CHECK(beyond->seconds.value == Approx(0.5 / target));
    CHECK(beyond->extrapolated);
  }
  CHECK_FALSE(CostToTarget(levels, 0.999 / 64000, 0.95));
  CHECK_FALSE(CostToTarget(levels, 1001, 0.95));
  CHECK_FALSE(CostToTarget(levels, 1.0 / 130, 0.95, 2));
}

TEST_CASE("the cost of a target counts from the last crossing", "[stat]") {
  const std::vector<Level> levels = {
      {16, {0.2}, {16}}, {4, {0.05}, {4}}, {1, {1.0}, {1}}, {64, {0.05}, {64}}};
  const auto cost = CostToTarget(levels, 0.1, 0.95);
  REQUIRE(cost);
  CHECK(cost->samples.value == Approx(32));  // halfway from 0.2 to 0.05
  CHECK(cost->seconds.value == Approx(32));
  CHECK_FALSE(cost->extrapolated);
  CHECK_FALSE(cost->samples.HasBounds());  // one repetition
}

TEST_CASE("the cost of a target is empty where the error does not fall", "[stat]") {
  const std::vector<Level> flat = {{1, {1, 1}, {1, 1}}, {4, {1, 1}, {4, 4}}};
  CHECK_FALSE(CostToTarget(flat, 0.5, 0.95));
  const std::vector<Level> rising = {{1, {1, 1}, {1, 1}}, {4, {2, 2}, {4, 4}}};
  CHECK_FALSE(CostToTarget(rising, 0.5, 0.95));
  CHECK_FALSE(CostToTarget({}, 0.5, 0.95));
  const std::vector<Level> one = {{4, {1, 1}, {4, 4}}};
  CHECK_FALSE(CostToTarget(one, 0.5, 0.95));
  REQUIRE(CostToTarget(one, 1, 0.95));
  CHECK(CostToTarget(one, 1, 0.95)->samples.value == Approx(4));
  // Levels whose error is zero or, less the reference's own, below are left out.
  const std::vector<Level> noisy = {
      {1, {1, 1}, {1, 1}}, {4, {0.25, 0.25}, {4, 4}}, {16, {-0.1, 0}, {16, 16}}};
  const auto cost = CostToTarget(noisy, 0.1, 0.95);
  REQUIRE(cost);
  CHECK(cost->samples.value == Approx(10));
  CHECK(cost->extrapolated);
}

TEST_CASE("intervals of the cost of a target have the stated coverage", "[stat]") {
  const int trials = 4000;
  const auto coverage = [&](double target, double common, double truth) {
    return Share(trials, 5, [&](Random& random) {
      const auto cost =
          CostToTarget(PowerLaw(random, -0.5, 0.2, common, 5), target, 0.95);
      return cost && cost->samples.Contains(truth);
    });
  };
  for (double common : {0.0, 0.9}) {
    for (double target : {0.12, 0.3, 0.003}) {
      const double fraction = coverage(target, common, 1 / target);
      INFO("target " << target << ", common " << common << ": " << fraction);
      CHECK(fraction > 0.94 - FiveSigma(0.94, trials));
      CHECK(fraction < 0.98);
    }
  }
  CHECK(coverage(0.12, 0, 1.5 / 0.12) < 0.5);  // a wrong cost is noticed
}

}  // namespace lanelight::stat
