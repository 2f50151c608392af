// What differs from the reference: a strategy, the reference itself, or too few samples
// to say so; by simulation, with known answers.
#include <catch2/catch.hpp>

#include "src/measure/study/analysis.h"
#include "tests/measure/study/simulated.h"

namespace lanelight {
namespace {

using reference::Random;

constexpr int kBiasWidth = 64, kBiasHeight = 48, kStrategies = 5, kRepetitions = 6;
constexpr std::uint64_t kSpp = 16;
constexpr std::size_t kTile = 2 * 8 + 1;  // of 8 x 6 tiles

void BrightenTile(std::vector<Rgb>& image) {
  for (int y = 16; y < 24; ++y) {
    for (int x = 8; x < 16; ++x) image[y * kBiasWidth + x] *= 1.15;
  }
}

using Change = std::function<void(std::vector<Rgb>&)>;

// Analysis of five strategies, of which the last has its images changed.
SceneAnalysis Analyse(const Reference& reference, Random& random,
                      const Change& of_last = {}, const Change& of_all = {}) {
  SceneAnalysis out;
  for (int i = 0; i < kStrategies; ++i) {
    const auto change = [&](std::vector<Rgb>& image) {
      if (of_all) of_all(image);
      if (i + 1 == kStrategies && of_last) of_last(image);
    };
    const Cells cells = Simulate(reference, kRepetitions, 0.1, random, change);
    StrategyAnalysis s;
    s.levels.push_back(AnalyseLevel(cells, reference, kSpp, 0.95));
    s.image_mean = ImageMean(cells.moments);
    s.tiles = TestTiles(cells.moments, reference, kSpp, kBiasLevel);
    out.strategies.push_back(std::move(s));
  }
  TestBias(reference, out);
  return out;
}

Reference TypicalReference(Random& random) {
  return NoisyReference(kBiasWidth, kBiasHeight, 0.01, random);
}

std::size_t FailedTiles(const SceneAnalysis& analysis) {
  std::size_t failed = 0;
  for (const StrategyAnalysis& s : analysis.strategies) failed += s.tiles->failed.size();
  return failed;
}

}  // namespace

TEST_CASE("an error of the reference is not attributed to the strategies", "[study]") {
  Random random(21);
  std::size_t suspected = 0, failed = 0, alike = 0, biased = 0;
  for (int run = 0; run < 20; ++run) {
    Reference r = TypicalReference(random);
    BrightenTile(r.mean);  // its variance does not know
    const SceneAnalysis tile = Analyse(r, random);
    failed += FailedTiles(tile);
    suspected += tile.suspect_tiles == std::vector<std::size_t>{kTile};
    Reference bright = TypicalReference(random);
    for (Rgb& c : bright.mean) c *= 1.03;
    const SceneAnalysis whole = Analyse(bright, random);
    alike += whole.biased_alike.size();
    biased += whole.biased.size();
  }
  CHECK(suspected >= 18);
  CHECK(alike >= 5 * 18);
  // 100 strategies of 20 references at a level of 0.001: a false alarm of three or more
  // has a probability of 2e-4.
  CHECK(failed <= 2);
  CHECK(biased <= 2);
}

TEST_CASE("the bias of one strategy is found among others", "[study]") {
  Random random(22);
  int tiles = 0, images = 0;
  for (int run = 0; run < 20; ++run) {
    const SceneAnalysis tile = Analyse(TypicalReference(random), random, BrightenTile);
    const TileTest& test = *tile.strategies.back().tiles;
    tiles += test.failed == std::vector<std::size_t>{kTile} && FailedTiles(tile) == 1;
    CHECK(test.z[kTile] > 0);
    const SceneAnalysis whole =
        Analyse(TypicalReference(random), random, [](std::vector<Rgb>& image) {
          for (Rgb& c : image) c *= 1.03;
        });
    images += whole.biased == std::vector<std::size_t>{kStrategies - 1} &&
              whole.biased_alike.empty();
  }
  CHECK(tiles >= 18);
  CHECK(images >= 18);
}

TEST_CASE("a tile of rare samples is not tested", "[study]") {
  // In the tile all light comes in samples that one pixel in 80 of an image gets: 5 of
  // them are expected in all repetitions of a strategy, and none come in one of 150.
  constexpr double kRarePixel = 1.0 / 80;
  Random random(23);
  const auto rare = [&random](std::vector<Rgb>& image) {
    for (int y = 16; y < 24; ++y) {
      for (int x = 8; x < 16; ++x) {
        const double hit = random.Uniform() < kRarePixel ? 1 : 0;
        image[y * kBiasWidth + x] = Rgb{1e-4 + hit, 1e-4 + hit, 1e-4 + hit};
      }
    }
  };
  std::size_t failed = 0, untested = 0;
  for (int run = 0; run < 60; ++run) {
    Reference r = TypicalReference(random);
    r.spp = 12 * kSpp * kRepetitions;
    for (int y = 16; y < 24; ++y) {
      for (int x = 8; x < 16; ++x) {
        double hits = 0;
        for (int i = 0; i < 12 * kRepetitions; ++i) hits += random.Uniform() < kRarePixel;
        const double n = 12.0 * kRepetitions;
        const Rgb one{1, 1, 1};
        r.mean[y * kBiasWidth + x] = one * (1e-4 + hits / n);
        r.variance[y * kBiasWidth + x] = one * (hits / n * (1 - hits / n) / n);
      }
    }
    const SceneAnalysis analysis = Analyse(r, random, {}, rare);
    failed += FailedTiles(analysis);
    for (const StrategyAnalysis& s : analysis.strategies) {
      untested += std::isnan(s.tiles->z[kTile]);
    }
  }
  // 300 strategies at a level of 0.001: four or more have a probability of 3e-4.
  CHECK(failed <= 3);
  CHECK(untested >= 290);
}

TEST_CASE("skewed samples raise no false alarms", "[study]") {
  // Bright samples, one in 120, so that about 26 of them make the mean of a tile: few of
  // them look like a low mean with a small variance.
  Random random(24);
  constexpr double kRare = 1.0 / 120;
  const auto bright = [&random](std::vector<Rgb>& image) {
    for (Rgb& c : image) {
      double hits = 0;
      for (int i = 0; i < 8; ++i) hits += random.Uniform() < kRare;
      c = Rgb{hits, hits, hits};
    }
  };
  std::size_t failed = 0;
  Reference r = TypicalReference(random);
  r.mean.assign(r.mean.size(), Rgb{8 * kRare, 8 * kRare, 8 * kRare});
  r.variance.assign(r.mean.size(), Rgb{});
  for (int run = 0; run < 120; ++run) {
    Random noise(static_cast<std::uint64_t>(run));
    for (int i = 0; i < kStrategies; ++i) {
      const Cells cells = Simulate(r, kRepetitions, 0, noise, bright);
      failed += TestTiles(cells.moments, r, kSpp, kBiasLevel).failed.size();
    }
  }
  // 600 families at a level of 0.001: five or more have a probability of 4e-4 at most.
  CHECK(failed <= 4);
}

}  // namespace lanelight
