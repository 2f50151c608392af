// Intervals hold as often as they say, by simulation; wrong twins do not.
#include "src/base/stat/interval.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "src/base/stat/distributions.h"
#include "tests/base/stat/simulate.h"

namespace lanelight::stat {
namespace {

using reference::Random;

std::vector<double> Normals(Random& random, int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& v : values) v = 3 + 2 * Normal(random);
  return values;
}

// MeanInterval with a mistake: a normal quantile, or division by n instead of n - 1.
bool WrongIntervalCovers(const std::vector<double>& values, bool normal, bool by_n) {
  const double n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (double v : values) mean += v / n;
  for (double v : values) squares += (v - mean) * (v - mean);
  const double quantile =
      normal ? NormalQuantile(0.975) : StudentTwoSidedQuantile(0.05, n - 1);
  return std::abs(mean - 3) <= quantile * std::sqrt(squares / (by_n ? n : n - 1) / n);
}

}  // namespace

TEST_CASE("intervals of means have the stated coverage", "[stat]") {
  const int trials = 20000;
  for (int n : {2, 3, 5, 12}) {
    for (double confidence : {0.8, 0.95, 0.999}) {
      const double coverage = Share(trials, 1, [&](Random& random) {
        return MeanInterval(Normals(random, n), confidence).Contains(3);
      });
      INFO("n = " << n << ", confidence " << confidence << ": " << coverage);
      CHECK(std::abs(coverage - confidence) < FiveSigma(confidence, trials));
    }
  }
  for (bool normal : {false, true}) {
    const double coverage = Share(trials, 2, [&](Random& random) {
      return WrongIntervalCovers(Normals(random, 5), normal, !normal);
    });
    CHECK(coverage < 0.95 - FiveSigma(0.95, trials));
  }
}

TEST_CASE("medians and means of few values", "[stat]") {
  CHECK(std::isnan(Median({})));
  CHECK(Median({7}) == 7);
  // Planted: without sorting, or with the upper one of two.
  CHECK(Median({9, 1, 4}) == 4);
  CHECK(Median({9, 1, 4, 6}) == 5);
  const std::vector<double> values = {9, 1, 4, 6};
  CHECK(Mean(values) == 5);
  CHECK(std::isnan(Mean({})));
}

TEST_CASE("intervals of means have defined ends", "[stat]") {
  CHECK(std::isnan(MeanInterval({}, 0.95).value));
  const std::vector<double> one = {4}, equal = {4, 4, 4, 4};
  CHECK(MeanInterval(one, 0.95).value == 4);
  CHECK_FALSE(MeanInterval(one, 0.95).HasBounds());
  const Interval same = MeanInterval(equal, 0.95);
  CHECK((same.value == 4 && same.low == 4 && same.high == 4));
}

TEST_CASE("intervals of medians have at least the stated coverage", "[stat]") {
  const int trials = 20000;
  for (int n : {2, 5, 6, 7, 20, 21, 100}) {
    // Skewed, and without a mean: only order matters.
    const double coverage = Share(trials, 3, [&](Random& random) {
      std::vector<double> values(static_cast<std::size_t>(n));
      for (double& v : values) v = std::exp(3 * Normal(random));
      return MedianInterval(values, 0.95).Contains(1);
    });
    INFO("n = " << n << ": " << coverage);
    // Fewer than six: the whole range, 1 - 2^(1 - n).
    const double minimum = std::min(0.95, 1 - std::pow(2.0, 1 - n));
    CHECK(coverage > minimum - FiveSigma(minimum, trials));
    // No wider than needed: one value less on both sides would not hold.
    if (n < 7) continue;
    const double narrow = Share(trials, 3, [&](Random& random) {
      std::vector<double> values(static_cast<std::size_t>(n));
      for (double& v : values) v = std::exp(3 * Normal(random));
      const Interval interval = MedianInterval(values, 0.95);
      std::sort(values.begin(), values.end());
      const auto low = std::lower_bound(values.begin(), values.end(), interval.low);
      const auto high = std::lower_bound(values.begin(), values.end(), interval.high);
      return *(low + 1) <= 1 && 1 <= *(high - 1);
    });
    CHECK(narrow < 0.95 - FiveSigma(0.95, trials));
  }
}

TEST_CASE("intervals of medians take the order statistics of the tables", "[stat]") {
  std::vector<double> values;
  for (int i = 1; i <= 20; ++i) values.push_back(i);
  const Interval twenty = MedianInterval(values, 0.95);
  CHECK((twenty.value == 10.5 && twenty.low == 6 && twenty.high == 15));
  values.resize(6);
  const Interval six = MedianInterval(values, 0.95);
  CHECK((six.value == 3.5 && six.low == 1 && six.high == 6));
  CHECK(std::isnan(MedianInterval({}, 0.95).value));
  values.resize(1);
  CHECK(MedianInterval(values, 0.95).value == 1);
  CHECK_FALSE(MedianInterval(values, 0.95).HasBounds());
}

TEST_CASE("intervals of proportions have the stated coverage averaged over proportions",
          "[stat]") {
  const int trials = 20000;
  for (int n : {10, 40, 100}) {
    const auto fraction = [&](bool wald) {
      return Share(trials, 4, [&](Random& random) {
        const double p = random.Uniform();
        std::uint64_t hits = 0;
        for (int i = 0; i < n; ++i) hits += random.Uniform() < p ? 1 : 0;
        if (!wald) return ProportionInterval(hits, n, 0.95).Contains(p);
        const double q = static_cast<double>(hits) / n;  // the usual wrong twin
        return std::abs(p - q) <= 1.96 * std::sqrt(q * (1 - q) / n);
      });
    };
    const double coverage = fraction(false);
    INFO("n = " << n << ": " << coverage);
    CHECK(std::abs(coverage - 0.95) <
          0.007);  // Brown, Cai and DasGupta 2001: 0.944 - 0.956
    CHECK(fraction(true) < 0.943);
  }
}

TEST_CASE("intervals of proportions have defined ends", "[stat]") {
  CHECK(std::isnan(ProportionInterval(0, 0, 0.95).value));
  const Interval none = ProportionInterval(0, 10, 0.95);
  CHECK((none.value == 0 && none.low == 0));
  CHECK(none.high == Approx(0.27753).epsilon(1e-4));  // z^2 / (n + z^2)
  const Interval all = ProportionInterval(10, 10, 0.95);
  CHECK((all.value == 1 && all.high == 1));
  CHECK(all.low == Approx(1 - none.high));
}

TEST_CASE("intervals of clustered proportions have the stated coverage", "[stat]") {
  // The ten trials of a cluster succeed together, but for one.
  const int trials = 4000;
  constexpr double kMean = 0.8;
  const auto draw = [](Random& random) {
    std::vector<Cluster> clusters;
    for (int i = 0; i < 24; ++i) {
      Cluster c{0, 10};
      c.successes = random.Uniform() < kMean ? 9 : 0;
      c.successes += random.Uniform() < kMean;
      clusters.push_back(c);
    }
    return clusters;
  };
  const double coverage = Share(trials, 3, [&](Random& random) {
    return ClusteredProportion(draw(random), 0.95).Contains(kMean);
  });
  CHECK(coverage > 0.92);
  const double as_independent = Share(trials, 3, [&](Random& random) {
    std::uint64_t successes = 0;
    for (const Cluster& c : draw(random)) successes += c.successes;
    return ProportionInterval(successes, 240, 0.95).Contains(kMean);
  });
  CHECK(as_independent < 0.6);
}

TEST_CASE("intervals of clustered proportions have defined ends", "[stat]") {
  CHECK(std::isnan(ClusteredProportion({}, 0.95).value));
  const std::vector<Cluster> one = {{3, 4}}, equal = {{4, 4}, {4, 4}, {4, 4}};
  CHECK(ClusteredProportion(one, 0.95).value == 0.75);
  CHECK_FALSE(ClusteredProportion(one, 0.95).HasBounds());
  const Interval all = ClusteredProportion(equal, 0.95);
  CHECK(all.high == 1);
  CHECK(all.low < ProportionInterval(12, 12, 0.95).low);  // Student's, of three clusters
}

}  // namespace lanelight::stat
