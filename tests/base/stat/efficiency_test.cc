// Ratios of efficiency: coverage for errors of several shapes, and rankings that claim no
// more than they know.
#include "src/base/stat/efficiency.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/base/stat/simulate.h"

namespace lanelight::stat {
namespace {

using reference::Random;
using Costs = std::vector<Cost>;

// How errors of the two strategies scatter about their means, which are 1 and 1 / 3.
struct Shape {
  const char* name;
  double sigma_a, sigma_b;   // log-normal; 0: chi-square
  double correlation;        // of the logarithms
  int degrees_a, degrees_b;  // of the chi-squares
  double minimum;            // coverage at 95 %
};

constexpr Shape kShapes[] = {
    {"log-normal 0.2", 0.2, 0.2, 0, 0, 0, 0.945},
    {"log-normal 0.2, correlated", 0.2, 0.2, 0.8, 0, 0, 0.945},
    {"log-normal 0.5 and 0.1", 0.5, 0.1, 0, 0, 0, 0.93},
    {"log-normal 1", 1, 1, 0, 0, 0, 0.92},
    {"log-normal 1 and 0.2", 1, 0.2, 0, 0, 0, 0.88},
    {"chi-square of 20 and 20", 0, 0, 0, 20, 20, 0.945},
    {"chi-square of 4 and 20", 0, 0, 0, 4, 20, 0.935},
};

void Simulate(Random& random, const Shape& s, std::size_t n, Costs& a, Costs& b) {
  a.assign(n, {});
  b.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    const double z = Normal(random), independent = Normal(random);
    const double w =
        s.correlation * z + std::sqrt(1 - s.correlation * s.correlation) * independent;
    a[i].error =
        s.sigma_a > 0 ? LogNormal(z, s.sigma_a) : ChiSquareMean(random, s.degrees_a);
    b[i].error =
        (s.sigma_b > 0 ? LogNormal(w, s.sigma_b) : ChiSquareMean(random, s.degrees_b)) /
        3;
    a[i].seconds = 2 * LogNormal(Normal(random), 0.02);
    b[i].seconds = 4 * LogNormal(Normal(random), 0.02);
  }
}
constexpr double kTrue = 1.5;  // a third of the error in twice the time

// The wrong twin: percentiles of resampled ratios.
Interval PercentileBootstrap(Random& random, const Costs& a, const Costs& b) {
  std::vector<double> ratios;
  for (int k = 0; k < 400; ++k) {
    double ea = 0, eb = 0, sa = 0, sb = 0;
    for (std::size_t j = 0; j < a.size(); ++j) {
      const std::size_t i = random.Bits() % a.size();
      ea += a[i].error;
      eb += b[i].error;
      sa += a[i].seconds;
      sb += b[i].seconds;
    }
    ratios.push_back(ea * sa / (eb * sb));
  }
  std::sort(ratios.begin(), ratios.end());
  return {ratios[200], ratios[10], ratios[389]};
}

double Coverage(const Shape& shape, std::size_t n, double confidence, int trials) {
  Costs a, b;
  return Share(trials, 5, [&](Random& random) {
    Simulate(random, shape, n, a, b);
    return EfficiencyRatio(a, b, confidence).Contains(kTrue);
  });
}

std::vector<Costs> Strategies(Random& random, int count, std::size_t n, double factor) {
  std::vector<Costs> all(static_cast<std::size_t>(count), Costs(n));
  double scale = 1;
  for (Costs& costs : all) {
    for (Cost& c : costs) {
      c = {scale * LogNormal(Normal(random), 0.3), LogNormal(Normal(random), 0.02)};
    }
    scale *= factor;
  }
  return all;
}

bool ClaimsAnything(const std::vector<RankRange>& ranks) {
  const int n = static_cast<int>(ranks.size());
  return std::any_of(ranks.begin(), ranks.end(),
                     [&](const RankRange& r) { return r.best != 1 || r.worst != n; });
}

}  // namespace

TEST_CASE("intervals of efficiency ratios have the stated coverage with four pairs",
          "[stat]") {
  const int trials = 20000;
  for (const Shape& shape : kShapes) {
    const double coverage = Coverage(shape, 4, 0.95, trials);
    INFO(shape.name << ": " << coverage);
    CHECK(coverage > shape.minimum - FiveSigma(shape.minimum, trials));
    CHECK(coverage < 0.96 + FiveSigma(0.96, trials));
    const double high = Coverage(shape, 4, 0.999, trials);
    INFO("at 99.9 %: " << high);
    CHECK(high > 0.9965 - FiveSigma(0.9965, trials));
  }
}

TEST_CASE("intervals of efficiency ratios have the stated coverage with more pairs",
          "[stat][slow]") {
  const int trials = 800;
  for (const Shape& shape : kShapes) {
    for (std::size_t n : {std::size_t{8}, std::size_t{16}}) {
      const double coverage = Coverage(shape, n, 0.95, trials);
      INFO(shape.name << ", " << n << " pairs: " << coverage);
      CHECK(coverage > shape.minimum - FiveSigma(shape.minimum, trials));
      CHECK(coverage < 0.965 + FiveSigma(0.965, trials));
      const double high = Coverage(shape, n, 0.999, trials);
      INFO("at 99.9 %: " << high);
      CHECK(high > 0.99 - FiveSigma(0.99, trials));
    }
  }
}

TEST_CASE("the percentile bootstrap of four pairs is shown to be too narrow", "[stat]") {
  const int trials = 2000;
  Costs a, b;
  const double coverage = Share(trials, 6, [&](Random& random) {
    Simulate(random, kShapes[0], 4, a, b);
    return PercentileBootstrap(random, a, b).Contains(kTrue);
  });
  CHECK(coverage < 0.945 - FiveSigma(0.945, trials));
}

TEST_CASE("ratios of efficiency are defined for zeros and few pairs", "[stat]") {
  const Costs two = {{1, 1}, {2, 1}}, other = {{0.5, 2}, {1, 2}};
  CHECK(EfficiencyRatio(two, other, 0.95).value == Approx(1));
  CHECK_FALSE(EfficiencyRatio(two, other, 0.95).HasBounds());
  const Costs black = {{0, 1}, {0, 1}, {0, 1}}, grey = {{1, 2}, {2, 2}, {3, 2}};
  CHECK(EfficiencyRatio(black, grey, 0.95).value == 0);
  CHECK(std::isinf(EfficiencyRatio(grey, black, 0.95).value));
  const Costs slow = {{0, 3}, {0, 3}, {0, 3}};
  CHECK(EfficiencyRatio(black, slow, 0.95).value == Approx(1.0 / 3));
  CHECK_FALSE(EfficiencyRatio(black, slow, 0.95).HasBounds());
  const Interval same = EfficiencyRatio(grey, grey, 0.95);
  CHECK((same.value == 1 && same.low == 1 && same.high == 1));
  CHECK(std::isnan(EfficiencyRatio({}, {}, 0.95).value));
  // All errors but one are zero: nothing is known about the mean.
  const Costs rare = {{0, 1}, {0, 1}, {5, 1}};
  CHECK(EfficiencyRatio(grey, rare, 0.95).value == Approx(2 * 2 / (5.0 / 3)));
  CHECK_FALSE(EfficiencyRatio(grey, rare, 0.95).HasBounds());
  // A clock that shows nothing.
  const Costs instant = {{1, 0}, {2, 0}, {3, 0}};
  CHECK(std::isfinite(EfficiencyRatio(grey, instant, 0.95).value));
}

TEST_CASE("the inverse of a ratio has the inverse interval", "[stat]") {
  Random random(8);
  Costs a, b;
  for (std::size_t n : {std::size_t{5}, std::size_t{12}}) {
    Simulate(random, kShapes[0], n, a, b);
    const Interval forth = EfficiencyRatio(a, b, 0.95),
                   back = EfficiencyRatio(b, a, 0.95);
    CHECK(forth.low < forth.value);
    CHECK(forth.high > forth.value);
    CHECK(forth.low * back.high == Approx(1).epsilon(1e-9));
    CHECK(forth.high * back.low == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("identical strategies rarely get different ranks", "[stat]") {
  const int trials = 4000;
  for (std::size_t n : {std::size_t{3}, std::size_t{6}}) {
    const double claims = Share(trials, 9, [&](Random& random) {
      return ClaimsAnything(RankByEfficiency(Strategies(random, 6, n, 1), 0.9));
    });
    INFO(n << " repetitions: " << claims);
    CHECK(claims < 0.1 + FiveSigma(0.1, trials));
  }
  // The wrong twin: fifteen pairs, each at the full level.
  const double claims = Share(1000, 9, [&](Random& random) {
    const auto all = Strategies(random, 6, 6, 1);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!EfficiencyRatio(all[i], all[j], 0.9).Contains(1)) return true;
      }
    }
    return false;
  });
  CHECK(claims > 0.1 + FiveSigma(0.1, 1000));
}

TEST_CASE("strategies that differ by a factor of three get different ranks", "[stat]") {
  const int trials = 20;
  const double right = Share(trials, 10, [&](Random& random) {
    const auto ranks = RankByEfficiency(Strategies(random, 4, 12, 3), 0.95);
    for (int i = 0; i < 4; ++i) {
      const RankRange& r = ranks[static_cast<std::size_t>(i)];
      if (r.best != i + 1 || r.worst != i + 1) return false;
    }
    return true;
  });
  CHECK(right == 1);
}

TEST_CASE("an error that all repetitions share widens a ratio and its ranks", "[stat]") {
  const Interval ratio = {2, 1.6, 2.5};
  const double z = 1.959964, deviation = 0.3;
  const Interval wide = Widened(ratio, deviation, 0.95);
  CHECK(wide.value == 2);
  CHECK(std::log(2 / wide.low) ==
        Approx(std::hypot(std::log(2 / 1.6), z * deviation)).epsilon(1e-6));
  CHECK(std::log(wide.high / 2) ==
        Approx(std::hypot(std::log(2.5 / 2), z * deviation)).epsilon(1e-6));
  CHECK(Widened(ratio, 0, 0.95).high == 2.5);
  CHECK_FALSE(Widened(WithoutBounds(2), 1, 0.95).HasBounds());

  Random random(9);
  std::vector<Costs> two(2);
  for (int i = 0; i < 8; ++i) {
    two[0].push_back({LogNormal(Normal(random), 0.05), 1});
    two[1].push_back({LogNormal(Normal(random), 0.05) / 1.5, 1});
  }
  CHECK(RankByEfficiency(two, 0.95)[0].best == 2);
  const std::vector<double> uncertainties = {0, 0.3};
  CHECK(RankByEfficiency(two, 0.95, uncertainties)[0].best == 1);
}

TEST_CASE("ranks do not depend on the order of the strategies", "[stat]") {
  Random random(11);
  auto all = Strategies(random, 5, 8, 1.5);
  const auto ranks = RankByEfficiency(all, 0.9);
  std::reverse(all.begin(), all.end());
  const auto reversed = RankByEfficiency(all, 0.9);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(ranks[i].best == reversed[4 - i].best);
    CHECK(ranks[i].worst == reversed[4 - i].worst);
  }
  CHECK(RankByEfficiency({}, 0.9).empty());
  CHECK(RankByEfficiency({all[0]}, 0.9)[0].worst == 1);
}

}  // namespace lanelight::stat
