// Error, variance and bias from repetitions, by simulation: intervals cover, tests raise
// no false alarms, planted biases are found.
#include <catch2/catch.hpp>

#include "src/measure/study/analysis.h"
#include "tests/measure/study/simulated.h"

namespace lanelight {
namespace {

using reference::Random;

constexpr int kWidth = 16, kHeight = 12;

struct Coverage {
  int variance = 0, bias = 0, bias2 = 0, rejected = 0, runs = 0;
};

// Returns the coverage for images whose every pixel is `factor` times its true value.
Coverage Cover(int runs, int repetitions, double factor, bool forget_reference) {
  Random random(31);
  Coverage coverage;
  coverage.runs = runs;
  const double expected_bias2 = (factor - 1) * (factor - 1);
  for (int run = 0; run < runs; ++run) {
    Reference r = NoisyReference(kWidth, kHeight, 0.02, random);
    const Cells cells =
        Simulate(r, repetitions, 0.1, random, [&](std::vector<Rgb>& image) {
          for (Rgb& c : image) c *= factor;
        });
    if (forget_reference) r.variance.clear();
    const LevelAnalysis level = AnalyseLevel(cells, r, 16, 0.95);
    // The relative measure divides by b^2 + 0.01, so it is a little below the square.
    double weight = 0;
    for (const Rgb& c : Truth(r.mean.size())) {
      for (int k = 0; k < 3; ++k) {
        weight += c[k] * c[k] / (c[k] * c[k] + 0.01) / 3 / double(r.mean.size());
      }
    }
    const double variance = 0.01 * factor * factor * weight;
    coverage.variance += level.variance.Contains(variance);
    coverage.bias += level.bias.Contains(factor - 1);
    coverage.bias2 += level.bias2.Contains(expected_bias2 * weight);
    coverage.rejected += *level.bias_p < 0.01;
  }
  return coverage;
}

}  // namespace

TEST_CASE("intervals of variance and bias contain the true values", "[study]") {
  const Coverage c = Cover(300, 8, 1, false);
  // 95 % of 300 are 285, with a standard deviation of 3.8.
  CHECK(c.bias >= 268);
  CHECK(c.bias2 >= 268);
  CHECK(c.variance >= 262);  // a t interval about a skewed mean of few
  CHECK(c.bias <= 299);
  CHECK(c.rejected <= 12);  // 1 % expected
  // Planted: the reference's noise counts as bias of the strategy.
  const Coverage wrong = Cover(300, 8, 1, true);
  CHECK(wrong.bias2 < 200);
}

TEST_CASE("two repetitions raise no false alarms either", "[study]") {
  const Coverage c = Cover(400, 2, 1, false);
  CHECK(c.rejected <= 16);
}

TEST_CASE("a bias of three percent is found and measured", "[study]") {
  const Coverage c = Cover(100, 8, 1.03, false);
  CHECK(c.rejected >= 95);
  CHECK(c.bias >= 85);
  CHECK(c.bias2 >= 85);
}

TEST_CASE("missing rare samples is not reported as bias", "[study]") {
  // 3 % too dark, and steady. By the reference's variance, independent samples scatter by
  // 3 % of the mean: 0.02 x sqrt(192) of a pixel is what its 192 pixels' mean varies by.
  Random random(6);
  Reference r = NoisyReference(kWidth, kHeight, 0.02 * std::sqrt(192), random);
  r.mean = Truth(r.mean.size());
  const Cells cells = Simulate(r, 4, 0.001, random, [](std::vector<Rgb>& image) {
    for (Rgb& c : image) c *= 0.97;
  });
  r.spp = 0;  // not known: its own scatter is believed
  for (Rgb& v : r.variance) v *= 1e-6;
  CHECK(*AnalyseLevel(cells, r, 16, 0.95).bias_p < 1e-9);
  r.spp = 1000000 * 16 * 4;
  CHECK(*AnalyseLevel(cells, r, 16, 0.95).bias_p > 0.01);
}

TEST_CASE("the mean error is variance plus squared bias", "[study]") {
  Random random(3);
  const Reference r = NoisyReference(kWidth, kHeight, 0.02, random);
  const LevelAnalysis level = AnalyseLevel(Simulate(r, 5, 0.2, random), r, 4, 0.95);
  CHECK(level.relmse.value == Approx(level.variance.value + level.bias2.value));
  double variance = 0;  // from its definition
  const Cells cells = [&] {
    Random again(3);
    const Reference same = NoisyReference(kWidth, kHeight, 0.02, again);
    return Simulate(same, 5, 0.2, again);
  }();
  for (std::size_t i = 0; i < r.mean.size(); ++i) {
    variance += Dot(cells.moments.Variance(i), r.Weight(i)) / 3 / double(r.mean.size());
  }
  CHECK(level.variance.value == Approx(variance));
}

TEST_CASE("degenerate renders have defined results", "[study]") {
  Random random(4);
  const Reference noisy = NoisyReference(kWidth, kHeight, 0.02, random);
  SECTION("one repetition") {
    const LevelAnalysis level =
        AnalyseLevel(Simulate(noisy, 1, 0.1, random), noisy, 4, 0.95);
    CHECK_FALSE(level.relmse.HasBounds());
    CHECK_FALSE(level.bias_p.has_value());
    CHECK(level.relmse.value > 0);
  }
  SECTION("black everywhere") {
    Reference black;
    black.width = kWidth;
    black.height = kHeight;
    black.mean.assign(kWidth * kHeight, Rgb{});
    black.variance = black.mean;
    const auto darken = [](std::vector<Rgb>& image) {
      for (Rgb& c : image) c = {};
    };
    const Cells cells = Simulate(black, 3, 0, random, darken);
    const LevelAnalysis level = AnalyseLevel(cells, black, 4, 0.95);
    CHECK(level.relmse.value == 0);
    CHECK(level.bias.value == 0);
    CHECK(*level.bias_p == 1);
    CHECK(level.worst_share == 0);
    CHECK(TestTiles(cells.moments, black, 4, 0.01).failed.empty());
  }
  SECTION("no variance, equal to the reference") {
    Reference exact = noisy;
    exact.mean = Truth(exact.mean.size());
    exact.variance.clear();
    const Cells cells = Simulate(exact, 4, 0, random);
    const LevelAnalysis level = AnalyseLevel(cells, exact, 4, 0.95);
    CHECK(level.relmse.value == 0);
    CHECK(*level.bias_p == 1);
    CHECK(level.bias2.low == level.bias2.high);
  }
  SECTION("no variance, another image") {
    Reference exact = noisy;
    exact.mean = Truth(exact.mean.size());
    exact.variance.clear();
    const Cells cells = Simulate(exact, 4, 0, random, [](std::vector<Rgb>& image) {
      for (Rgb& c : image) c *= 1.01;
    });
    CHECK(*AnalyseLevel(cells, exact, 4, 0.95).bias_p == 0);
  }
}

TEST_CASE("only tiles that differ are reported", "[study]") {
  Random random(8);
  int alarms = 0, found = 0, misplaced = 0;
  for (int run = 0; run < 60; ++run) {
    const Reference r = NoisyReference(64, 48, 0.01, random);
    alarms += !TestTiles(Simulate(r, 6, 0.1, random).moments, r, 16, 0.01).failed.empty();
    const auto brighten = [](std::vector<Rgb>& image) {
      for (int y = 16; y < 24; ++y) {
        for (int x = 8; x < 16; ++x) image[y * 64 + x] *= 1.15;
      }
    };
    const TileTest test =
        TestTiles(Simulate(r, 6, 0.1, random, brighten).moments, r, 16, 0.01);
    REQUIRE(test.layout.side == 8);
    REQUIRE(test.layout.columns == 8);
    for (std::size_t tile : test.failed) {
      ++(tile == 2 * 8 + 1 ? found : misplaced);
    }
    CHECK(test.z[2 * 8 + 1] > 0);
  }
  CHECK(alarms <= 5);  // 0.6 expected
  CHECK(misplaced <= 5);
  CHECK(found >= 50);
}

TEST_CASE("tiles of pixels with common paths raise no false alarms", "[study]") {
  // All pixels of a block of 16 x 16 have one error, as those of path reuse have a part
  // of theirs: the variance of a tile's mean is that of a pixel.
  Random random(9);
  int independent = 0, alarms = 0;
  for (int run = 0; run < 40; ++run) {
    const Reference r = NoisyReference(64, 48, 0.001, random);
    const auto shift = [&](std::vector<Rgb>& image) {
      double error[3][4];
      for (auto& row : error) {
        for (double& e : row) e = 1 + 0.05 * (random.Uniform() - 0.5);
      }
      for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) image[y * 64 + x] *= error[y / 16][x / 16];
      }
    };
    Moments moments = Simulate(r, 6, 0.001, random, shift).moments;
    independent += !TestTiles(moments, r, 16, 0.01).failed.empty();
    moments.pixels_as_one = DependenceFactor(16 * 16);
    alarms += !TestTiles(moments, r, 16, 0.01).failed.empty();
  }
  CHECK(independent == 40);
  CHECK(alarms <= 3);
}

}  // namespace lanelight
