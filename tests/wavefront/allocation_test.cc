// allocation=error: who gets how many samples, and that a pixel's number of samples does
// not depend on its own.
#include "src/wavefront/allocation.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/estimate/estimate.h"
#include "src/wavefront/run.h"
#include "tests/wavefront/simulated_pixels.h"

namespace lanelight::test {
namespace {

constexpr int kCell = 4;

int ColourOf(int x, int y) { return (x / kCell + y / kCell) & 1; }

// Noise that grows to the right.
float Noisy(int x, int, std::mt19937_64& random) {
  return static_cast<float>(1 +
                            0.05 * (1 + x) * std::normal_distribution<double>()(random));
}

// Samples of either colour come from numbers of their own.
FilmAccumulator PilotOf(std::uint64_t seed_of_black, std::uint64_t seed_of_white) {
  std::mt19937_64 numbers[] = {std::mt19937_64(seed_of_black),
                               std::mt19937_64(seed_of_white)};
  FilmAccumulator film(0, 0, 34, 19, kReplicated, Auxiliary::kNone);
  ForPixels(film, [&](int x, int y) {
    AddDrawn(film, x, y, kAllocationPilot, Noisy, numbers[ColourOf(x, y)]);
  });
  return film;
}

double MeanWeight(const std::vector<double>& weights, int width, int colour) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    if (ColourOf(x, y) != colour) continue;
    sum += weights[i];
    ++count;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("a share never falls, has whole turns, and is inverted", "[allocation]") {
  for (double weight : {kLeastShare, 0.7, 1.0, 1.3, kMostShare}) {
    for (std::uint32_t turn : {1u, 4u, 8u}) {
      const Share share = {weight, 0.3, turn};
      INFO(weight << ", turns of " << turn);
      std::uint64_t last = 0;
      for (std::uint64_t mean = 0; mean < 300; ++mean) {
        const std::uint64_t samples = share.Samples(mean);
        REQUIRE(samples >= last);
        if (mean <= kAllocationPilot) REQUIRE(samples == mean);
        if (weight != 1) REQUIRE((mean < 16 || samples % turn == 0));
        REQUIRE(share.Samples(share.Mean(samples)) == samples);
        REQUIRE(share.Samples(share.Mean(samples) + 1) > samples);
        // Between two of its numbers, as after a task that was put down.
        REQUIRE(share.Mean(samples + 1) >= share.Mean(samples));
        last = samples;
      }
      CHECK(std::abs(double(last) - 16 - 283 * weight) <= turn);
    }
  }
}

TEST_CASE("a share ends where the indices of samples end", "[allocation]") {
  constexpr std::uint64_t kEnd = kSamplesPerSeed;
  for (double weight : {kLeastShare, 0.9, 1.0, kMostShare}) {
    const Share share = {weight, 0.5, 8};
    std::uint64_t last = 0;
    for (std::uint64_t mean = 1; mean < 4 * kEnd; mean += mean / 3 + 1) {
      const std::uint64_t samples = share.Samples(mean);
      CHECK(samples >= last);
      CHECK((samples < kEnd) == (mean < kEnd));
      CHECK(share.Mean(samples) >= mean);
      last = samples;
    }
    CHECK(share.Samples(kEnd) == kEnd);
    CHECK(share.Samples(kEnd + 5) == kEnd + 5);
  }
}

TEST_CASE("weights of a cell do not depend on samples of its colour", "[allocation]") {
  const FilmAccumulator film = PilotOf(1, 2);
  const std::vector<double> weights = WeighPixels(film, kCell);
  const std::vector<double> others[] = {WeighPixels(PilotOf(7, 2), kCell),
                                        WeighPixels(PilotOf(1, 7), kCell)};
  for (int changed : {0, 1}) {
    std::size_t moved = 0;
    ForPixels(film, [&](int x, int y) {
      const auto i = static_cast<std::size_t>(y * film.width() + x);
      if (ColourOf(x, y) == changed) {
        CHECK(others[changed][i] == weights[i]);
      } else {
        moved += others[changed][i] != weights[i];
      }
    });
    CHECK(moved > weights.size() / 4);
  }
}

namespace {

// Samples f + D of which a control variate D is fitted away, with help of neighbours.
FilmAccumulator ControlledPilot(std::uint64_t seed_of_black,
                                std::uint64_t seed_of_white) {
  std::mt19937_64 numbers[] = {std::mt19937_64(seed_of_black),
                               std::mt19937_64(seed_of_white)};
  FilmAccumulator film(0, 0, 34, 19, kReplicated, Auxiliary::kNone);
  film.UseDifferences();
  ForPixels(film, [&](int x, int y) {
    std::mt19937_64& random = numbers[ColourOf(x, y)];
    float value[kAllocationPilot], difference[kAllocationPilot];
    for (std::size_t i = 0; i < kAllocationPilot; ++i) {
      difference[i] = 0.3f * (Noisy(5, 0, random) - 1);
      value[i] = Noisy(x, y, random) + difference[i];
    }
    const float* const planes[] = {value,      value,      value,
                                   difference, difference, difference};
    film.AddSamples(x, y, planes, kAllocationPilot);
  });
  film.FitControl();
  return film;
}

}  // namespace

TEST_CASE("nor do they where a control variate is fitted", "[allocation]") {
  const FilmAccumulator film = ControlledPilot(1, 2), other = ControlledPilot(7, 2);
  const std::vector<double> weights = WeighPixels(film, kCell),
                            others = WeighPixels(other, kCell);
  bool fit_knows_neighbours = false;
  ForPixels(film, [&](int x, int y) {
    const auto i = static_cast<std::size_t>(y * film.width() + x);
    if (ColourOf(x, y) == 0) {
      CHECK(others[i] == weights[i]);
    } else {
      fit_knows_neighbours |= !(film.Variance(x, y) == other.Variance(x, y));
    }
  });
  CHECK(fit_knows_neighbours);  // else this would show nothing
}

TEST_CASE("weights have mean 1, limits, and follow the error", "[allocation]") {
  const FilmAccumulator film = PilotOf(1, 2);
  const std::vector<double> weights = WeighPixels(film, kCell);
  for (int colour : {0, 1}) {
    CHECK(MeanWeight(weights, film.width(), colour) == Approx(1).epsilon(1e-9));
  }
  for (double w : weights) CHECK((w >= kLeastShare && w <= kMostShare));
  for (int y = 0; y < 16; ++y) {
    const auto row = static_cast<std::size_t>(y * film.width());
    for (std::size_t x = 8; x < 24; ++x) CHECK(weights[row + x] < weights[row + x + 8]);
  }
}

TEST_CASE("one bright sample takes little from the others", "[allocation]") {
  std::mt19937_64 random(3);
  int drawn = 0;
  const auto draw = [&](int x, int y, std::mt19937_64& numbers) {
    const float noisy = 1 + 0.1f * (Noisy(0, 0, numbers) - 1);
    return x == 33 && y == 33 && drawn++ == 0 ? 1e6f : noisy;
  };
  const std::vector<double> weights = WeighPixels(Pilot(64, 64, draw, random), kCell);
  double taken = 0;
  for (double w : weights) taken += w > 2 ? w - 1 : 0;
  CHECK(taken > 0);
  CHECK(taken < 0.25 * double(weights.size()));
  CHECK(*std::min_element(weights.begin(), weights.end()) >= kLeastShare);
}

TEST_CASE("without an error, or with one cell, all have as many", "[allocation]") {
  std::mt19937_64 random(4);
  const auto black = [](int, int, std::mt19937_64&) { return 0.0f; };
  for (double w : WeighPixels(Pilot(20, 20, black, random), kCell)) CHECK(w == 1);
  for (int side : {1, 3}) {
    for (double w : WeighPixels(Pilot(side, side, Noisy, random), kCell)) CHECK(w == 1);
  }
  // A cell of each colour.
  for (double w : WeighPixels(Pilot(8, 3, Noisy, random), kCell)) CHECK(w == Approx(1));
  for (double w : WeighPixels(Pilot(1, 40, Noisy, random), kCell)) {
    CHECK((w >= kLeastShare && w <= kMostShare));
  }
}

TEST_CASE("cells are smaller in small images, and share out all pixels", "[allocation]") {
  CHECK(CellSide({0, 0, 900, 900}) > CellSide({0, 0, 9, 9}));
  std::uint64_t pixels = 0;
  for (const PixelRect& cell : CellsOf({5, 3, 47, 39})) {
    pixels += cell.pixels();
    CHECK(cell.x0 / 4 == (cell.x1 - 1) / 4);
  }
  CHECK(pixels == 42 * 36);
}

namespace {

// Few samples are very bright.
constexpr double kRate = 0.002, kBright = 100, kDim = 0.2;
constexpr double kTruth = kDim + kRate * kBright;

float RarelyBright(int, int, std::mt19937_64& random) {
  const bool bright = std::uniform_real_distribution<double>()(random) < kRate;
  return static_cast<float>(kDim + (bright ? kBright : 0));
}

// What must not be done: weights of cells by their own samples.
std::vector<double> WeighByOwn(const FilmAccumulator& film) {
  std::vector<double> weights;
  double sum = 0;
  ForPixels(film, [&](int x, int y) {
    double error = 0;
    for (int b = y / kCell * kCell; b < y / kCell * kCell + kCell; ++b) {
      for (int a = x / kCell * kCell; a < x / kCell * kCell + kCell; ++a) {
        error += std::sqrt(film.PlainVariance(a, b).x);
      }
    }
    weights.push_back(std::max(error, 0.1));
    sum += weights.back();
  });
  for (double& w : weights) {
    w = std::clamp(w * double(weights.size()) / sum, kLeastShare, kMostShare);
  }
  return weights;
}

struct Trials {
  double mean = 0, deviation = 0;  // of the image's mean less the truth
  double z_variance = 0;           // of squared errors less estimated variances
  double z_planted = 0;  // the same with the variance of as many samples everywhere
};

struct Moments {
  double n = 0, sum = 0, squares = 0;
  void Add(double v) { ++n, sum += v, squares += v * v; }
  double Mean() const { return sum / n; }
  double Error() const { return std::sqrt((squares / n - Mean() * Mean()) / n); }
};

Trials TrialsOf(const Weigh& weigh, int count) {
  constexpr int kSize = 16;
  constexpr std::uint64_t kMean = 64;
  std::mt19937_64 random(11);
  Moments bias, variance, planted;
  for (int trial = 0; trial < count; ++trial) {
    const FilmAccumulator film =
        Simulate(kSize, kSize, kMean, RarelyBright, weigh, random);
    double error = 0, excess = 0, wrong = 0;
    ForPixels(film, [&](int x, int y) {
      const double e = film.Mean(x, y).x - kTruth, v = film.Variance(x, y).x;
      error += e;
      excess += e * e - v;
      wrong += e * e - v * double(film.Samples(x, y)) / double(kMean);
    });
    bias.Add(error);
    variance.Add(excess);
    planted.Add(wrong);
  }
  return {bias.Mean() / (kSize * kSize), bias.Error() / (kSize * kSize),
          variance.Mean() / variance.Error(), planted.Mean() / planted.Error()};
}

}  // namespace

// False alarms: 5 standard errors, 6e-7 each.
TEST_CASE("rare bright samples: means and variances are unbiased", "[allocation]") {
  const auto weigh = [](const FilmAccumulator& film) { return WeighPixels(film, kCell); };
  const Trials fair = TrialsOf(weigh, 400);
  CHECK(std::abs(fair.mean) < 5 * fair.deviation);
  CHECK(5 * fair.deviation < 0.05 * kTruth);
  CHECK(std::abs(fair.z_variance) < 5);
  CHECK(std::abs(fair.z_planted) > 5);
}

TEST_CASE("planted: weights by a cell's own samples are biased", "[allocation]") {
  const Trials biased = TrialsOf(WeighByOwn, 400);
  CHECK(biased.mean < -5 * biased.deviation);
  CHECK(biased.mean < -0.05 * kTruth);
}

namespace {

// Means and noise that vary over the image, with long tails.
double TruthAt(int x, int y) { return 0.1 + 0.02 * x + 0.01 * y; }
float LongTailed(int x, int y, std::mt19937_64& random) {
  const double noise = std::exponential_distribution<double>()(random) - 1;
  return static_cast<float>(TruthAt(x, y) * (1 + (0.2 + 0.3 * (x % 24)) * noise));
}

}  // namespace

// 90 of 100 hold with probability 0.99; 84 or fewer happen once in 10^4.
TEST_CASE("intervals hold where samples are shared out", "[allocation]") {
  std::mt19937_64 random(12);
  const auto weigh = [](const FilmAccumulator& film) { return WeighPixels(film, kCell); };
  int held = 0;
  constexpr int kTrials = 100, kWidth = 48, kHeight = 24;
  for (int trial = 0; trial < kTrials; ++trial) {
    const FilmAccumulator film = Simulate(kWidth, kHeight, 64, LongTailed, weigh, random);
    double relmse = 0;
    ForPixels(film, [&](int x, int y) {
      const double truth = TruthAt(x, y), e = film.Mean(x, y).x - truth;
      relmse += e * e / (truth * truth + kRelativeEpsilon) / (kWidth * kHeight);
    });
    const ErrorEstimate estimate = EstimateError(film);
    held += estimate.relmse.low <= relmse && relmse <= estimate.relmse.high;
  }
  CHECK(held > 84);
}

}  // namespace lanelight::test
