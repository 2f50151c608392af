// The film: means, and variances of replicates or units against closed forms; no loss of
// precision over ten million samples.
#include "src/render/films/accumulator.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

namespace lanelight {
namespace {

constexpr SampleGroups kSingle = {1, false}, kPairs = {2, false};
constexpr SampleGroups kReplicated = {1, true}, kPairsReplicated = {2, true};

void Add(FilmAccumulator& film, const std::vector<float>& values) {
  const float* planes[3] = {values.data(), values.data(), values.data()};
  film.AddSamples(0, 0, planes, static_cast<std::uint32_t>(values.size()));
}

FilmAccumulator FilmOf(const SampleGroups& groups, const std::vector<float>& values) {
  FilmAccumulator film(0, 0, 1, 1, groups, Auxiliary::kNone);
  Add(film, values);
  return film;
}

// A sum that loses nothing (Neumaier 1974).
struct PlainCompensated {
  double sum = 0, lost = 0;
  void Add(double v) {
    const double next = sum + v;
    lost += std::abs(sum) >= std::abs(v) ? (sum - next) + v : (v - next) + sum;
    sum = next;
  }
  double Total() const { return sum + lost; }
};

}  // namespace

TEST_CASE("film: mean and variance of independent samples", "[film]") {
  const FilmAccumulator film = FilmOf(kSingle, {1, 2, 3, 6});
  CHECK(film.Mean(0, 0).x == Approx(3));
  // Scatter (4 + 1 + 0 + 9) / 3 over 4 samples.
  CHECK(film.Variance(0, 0).y == Approx(14.0 / 3 / 4));
  CHECK(film.Observations(0, 0) == 4);
  CHECK_FALSE(FilmOf(kSingle, {1}).HasVariance(0, 0));
  CHECK(FilmOf(kSingle, {}).Mean(0, 0) == Rgb{});
}

TEST_CASE("film: a pair is one observation", "[film]") {
  // Means 2, 2, 2: the scatter inside the pairs must not count.
  const FilmAccumulator even = FilmOf(kPairs, {1, 3, 0, 4, -1, 5});
  CHECK(even.Observations(0, 0) == 3);
  CHECK(even.Mean(0, 0).x == Approx(2));
  CHECK(even.Variance(0, 0).x == 0);
  CHECK_FALSE(FilmOf(kPairs, {1, 3, 0}).HasVariance(0, 0));
  // Means 3, 5, 1: scatter 4 over 3. A sample without partner is in the mean, and takes
  // its share of the variance away: 6 of 7 samples.
  const FilmAccumulator odd = FilmOf(kPairs, {1, 5, 2, 8, 3, -1, 9});
  CHECK(odd.Observations(0, 0) == 3);
  CHECK(odd.Mean(0, 0).x == Approx(27.0 / 7));
  CHECK(odd.Variance(0, 0).x == Approx(4.0 / 3 * 6 / 7));
}

TEST_CASE("film: replicates are the observations", "[film]") {
  // Means 3, 5, 1, 7: what differs within a replicate does not count.
  const FilmAccumulator film = FilmOf(kReplicated, {1, 9, 0, 5, 2, 2, 2, 10, 6, 4, 1, 6});
  CHECK(film.Observations(0, 0) == 4);
  CHECK(film.Mean(0, 0).x == Approx(4));
  // Scatter (1 + 1 + 9 + 9) / 3 over 4.
  CHECK(film.Variance(0, 0).x == Approx(20.0 / 3 / 4));
  // By pairs the same values belong elsewhere: means 11/4, 3/2, 9, 3/2 of 4, 2, 2, 2...
  const FilmAccumulator pairs = FilmOf(kPairsReplicated, {1, 5, 0, 3, 8, 10, 2, 1, 3, 2});
  CHECK(pairs.Observations(0, 0) == 4);
  const double mean = 3.5;
  const double d[] = {11 - 4 * mean, 3 - 2 * mean, 18 - 2 * mean, 3 - 2 * mean};
  const double squares = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3];
  CHECK(pairs.Mean(0, 0).x == Approx(mean));
  CHECK(pairs.Variance(0, 0).x == Approx(squares / (10 - 28.0 / 10) / 10));
}

TEST_CASE("film: few samples have few replicates", "[film]") {
  CHECK_FALSE(FilmOf(kReplicated, {3}).HasVariance(0, 0));
  CHECK_FALSE(FilmOf(kPairsReplicated, {3, 4}).HasVariance(0, 0));
  const FilmAccumulator two = FilmOf(kReplicated, {3, 5});
  CHECK(two.HasVariance(0, 0));
  CHECK(two.Variance(0, 0).x == Approx(1));  // 2 over 2
  CHECK(FilmOf(kPairsReplicated, {3, 4, 5}).Observations(0, 0) == 2);
}

TEST_CASE("film: the variance is right for any number of samples", "[film]") {
  // Independent samples, so that the truth is known: sigma^2 / n.
  std::mt19937 random(5);
  std::exponential_distribution<float> exponential(1);
  for (const SampleGroups& groups : {kSingle, kPairs, kReplicated, kPairsReplicated}) {
    for (int n : {4, 5, 6, 7, 11, 100}) {
      if (n < 2 * static_cast<int>(groups.unit)) continue;
      constexpr int kTrials = 40000;
      double sum = 0, squares = 0;
      for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<float> values(static_cast<std::size_t>(n));
        for (float& v : values) v = exponential(random);
        const double variance = FilmOf(groups, values).Variance(0, 0).x;
        sum += variance / kTrials;
        squares += variance * variance / kTrials;
      }
      const double truth = 1.0 / n;
      const double sigma = std::sqrt((squares - sum * sum) / kTrials);
      CAPTURE(groups.unit, groups.replicates, n, sum, truth);
      // 5 deviations: two false alarms in 10^5 runs of all; a bias of 15 % is seen.
      CHECK(std::abs(sum - truth) < 5 * sigma);
      CHECK(10 * sigma < 0.3 * truth);
    }
  }
}

TEST_CASE("film: the variance is right to 1e-3 beside a mean of 1e6", "[film]") {
  // Samples of +1 and -1; blocks of four share a sign where single samples scatter.
  for (const bool replicates : {false, true}) {
    for (float mean = 1; mean < 2e6f; mean *= 10) {
      std::vector<float> values;
      for (int i = 0; i < 4096; ++i) {
        values.push_back(mean + ((replicates ? i : i / 4) % 2 == 0 ? 1.f : -1.f));
      }
      CAPTURE(replicates, mean);
      CHECK(FilmOf({1, replicates}, values).Variance(0, 0).x ==
            Approx(1 / (replicates ? 3.0 : 4095.0)).epsilon(1e-3));
    }
  }
}

TEST_CASE("film: dependent samples of unequal replicates", "[film]") {
  // Replicates that repeat one number each: the variance of a sum is that of n_r^2
  // samples, which the film takes to be in proportion to n_r. Right for whole turns, and
  // not far off with one sample more.
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform;
  constexpr int kTrials = 40000;
  for (int n : {400, 401}) {
    double sum = 0, mean = 0, square = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      float own[kReplicates];
      for (float& v : own) v = uniform(random);
      std::vector<float> values;
      for (int i = 0; i < n; ++i) values.push_back(own[i % 4]);
      const FilmAccumulator film = FilmOf(kReplicated, values);
      sum += film.Variance(0, 0).x / kTrials;
      mean += film.Mean(0, 0).x / kTrials;
      square += film.Mean(0, 0).x * film.Mean(0, 0).x / kTrials;
    }
    const double truth = 1.0 / 12 / 4;
    CHECK(sum == Approx(truth).epsilon(0.03));
    CHECK(square - mean * mean == Approx(truth).epsilon(0.04));
  }
}

TEST_CASE("film: bit-identical for any split of the samples", "[film]") {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(1, 3);
  std::vector<float> values(1003);
  for (float& v : values) v = normal(random);
  for (const SampleGroups& groups : {kSingle, kPairs, kReplicated, kPairsReplicated}) {
    const FilmAccumulator whole = FilmOf(groups, values);
    FilmAccumulator parts(0, 0, 1, 1, groups, Auxiliary::kNone);
    for (std::size_t i = 0; i < values.size();) {
      const std::size_t n = std::min<std::size_t>(values.size() - i, random() % 10);
      Add(parts,
          {values.begin() + std::ptrdiff_t(i), values.begin() + std::ptrdiff_t(i + n)});
      i += n;
    }
    CHECK(whole.Mean(0, 0) == parts.Mean(0, 0));
    CHECK(whole.Variance(0, 0) == parts.Variance(0, 0));
    CHECK(whole.Variance(0, 0).x > 0);
  }
}

// Each of n additions rounds by half the last of 53 bits at most; with random signs they
// are off by sqrt(n) / 3 of that: 1e-13 for ten million. Single precision would be off by
// 1e-4 and more.
TEST_CASE("film: ten million samples lose no precision", "[film]") {
  std::mt19937 random(8);
  std::exponential_distribution<float> exponential(1);
  for (const SampleGroups& groups : {kSingle, kPairs, kReplicated}) {
    FilmAccumulator film(0, 0, 1, 1, groups, Auxiliary::kNone);
    PlainCompensated sum, squares, of[kReplicates];
    std::uint64_t n = 0;
    for (int call = 0; call < 10000; ++call) {
      std::vector<float> values(1000);
      // A rare sample is 10^5 times as bright as others.
      for (float& v : values) v = exponential(random) * (n % 9973 == 0 ? 1e5f : 1.0f);
      for (std::size_t i = 0; i < values.size(); ++i, ++n) {
        const double v = double(values[i]);
        sum.Add(v);
        of[n % kReplicates].Add(v);
        if (groups.unit == 1) squares.Add(v * v);
        if (groups.unit == 2 && i % 2 == 1) {
          const double mean = (double(values[i - 1]) + v) / 2;
          squares.Add(mean * mean);
        }
      }
      Add(film, values);
    }
    const double total = sum.Total(), count = double(n);
    CHECK(std::abs(film.Mean(0, 0).z / (total / count) - 1) < 1e-12);
    double variance = 0;
    if (groups.replicates) {
      for (const PlainCompensated& s : of) {
        const double d = s.Total() - total / kReplicates;
        variance += d * d / (count * count * (1 - 1.0 / kReplicates));
      }
    } else {
      const double units = count / groups.unit, mean = total / count;
      variance = (squares.Total() / units - mean * mean) / (units - 1);
    }
    // The scatter is a difference of numbers that are larger than itself.
    CHECK(std::abs(film.Variance(0, 0).z / variance - 1) < 1e-9);
  }
}

}  // namespace lanelight
