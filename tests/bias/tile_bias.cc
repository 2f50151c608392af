#include "tests/bias/tile_bias.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"

namespace lanelight::test {
namespace {

/// Relative difference that is rounding: films are float at the end, paths throughout.
constexpr double kRounding = 1e-4;
/// Share of the image's mean that a pixel's value is at least weighed with.
constexpr double kDarkest = 0.1;
constexpr int kWeightSpp = 64;

struct Place {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Tiles row by row, then the whole image.
std::vector<Place> PlacesOf(int width, int height, int tile) {
  std::vector<Place> places;
  for (int y = 0; y < height; y += tile) {
    for (int x = 0; x < width; x += tile) {
      places.push_back({x, y, std::min(x + tile, width), std::min(y + tile, height)});
    }
  }
  places.push_back({0, 0, width, height});
  return places;
}

// The weighted mean of the difference over a place.
Rgb DifferenceAt(const Place& place, const SeedImage& test, const SeedImage& base,
                 const std::vector<double>& weights) {
  Rgb sum;
  for (int y = place.y0; y < place.y1; ++y) {
    for (int x = place.x0; x < place.x1; ++x) {
      const auto at = static_cast<std::size_t>(y * test.width + x);
      sum += weights[at] * (test.pixels[at] - base.pixels[at]);
    }
  }
  return sum / (double(place.x1 - place.x0) * double(place.y1 - place.y0));
}

// Three channels of each place.
std::vector<stat::MeanEstimate> DifferencesOf(const std::vector<Place>& places,
                                              const std::vector<SeedImage>& tests,
                                              const std::vector<SeedImage>& bases,
                                              const std::vector<double>& weights) {
  const double n = double(tests.size());
  std::vector<stat::MeanEstimate> out;
  for (const Place& place : places) {
    std::vector<Rgb> of_seeds;
    Rgb mean, squares;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      of_seeds.push_back(DifferenceAt(place, tests[i], bases[i], weights));
      mean += of_seeds.back() / n;
    }
    for (const Rgb& d : of_seeds) squares += (d - mean) * (d - mean);
    for (int c = 0; c < 3; ++c) {
      out.push_back({mean[c], squares[c] / (n * (n - 1)), n - 1});
    }
  }
  return out;
}

// A rare bright sample that no seed has met in a tile has fallen into a neighbour: the
// variance is at least the mean of those around.
void SetVariances(int columns, std::vector<stat::MeanEstimate>& tests) {
  const std::size_t tiles = tests.size() / 3 - 1;
  const int rows = static_cast<int>(tiles) / columns;
  const std::vector<stat::MeanEstimate> own = tests;
  for (std::size_t t = 0; t < tiles; ++t) {
    const int row = static_cast<int>(t) / columns, column = static_cast<int>(t) % columns;
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      int count = 0;
      for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1);
             ++x, ++count) {
          sum += own[3 * static_cast<std::size_t>(y * columns + x) + c].variance;
        }
      }
      double& variance = tests[3 * t + c].variance;
      variance = std::max(variance, sum / count);
    }
  }
}

double PValue(const stat::MeanEstimate& difference) {
  return stat::WelchPValue(difference, {0, 0, difference.dof}, kRounding);
}

// Difference that a test of this level finds with probability 0.95.
double Power(const std::vector<stat::MeanEstimate>& differences, double level) {
  std::vector<double> errors;
  for (const stat::MeanEstimate& d : differences) errors.push_back(std::sqrt(d.variance));
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  const double reach = stat::NormalQuantile(1 - level / 2) + stat::NormalQuantile(0.95);
  return reach * errors[errors.size() / 2];
}

}  // namespace

std::vector<BiasRound> ScreeningRounds() {
  return {{16, 16, 1e-3}, {32, 32, 5e-3}, {64, 64, 1e-3}};
}

std::vector<BiasRound> LongRounds() {
  return {{16, 32, 1e-3}, {32, 64, 5e-3}, {64, 128, 1e-3}};
}

BiasTest::BiasTest(PreparedScene scene, std::string base, std::vector<BiasRound> rounds,
                   int tile)
    : scene_(std::move(scene)),
      base_(std::move(base)),
      rounds_(std::move(rounds)),
      tile_(tile),
      base_images_(rounds_.size()) {}

// Every round has seeds of its own.
SeedRange BiasTest::SeedsOf(std::size_t round) const {
  return {1000 * (round + 1), rounds_[round].seeds, rounds_[round].spp};
}

SeedRange BiasTest::FirstSeed() const {
  SeedRange seeds = SeedsOf(0);
  seeds.count = 1;
  return seeds;
}

bool BiasTest::RendersBase(const std::vector<SeedImage>& image) {
  const std::vector<Rgb>& base = Base(0)[0].pixels;
  return std::equal(base.begin(), base.end(), image[0].pixels.begin(),
                    [](const Rgb& a, const Rgb& b) { return a == b; });
}

const std::vector<SeedImage>& BiasTest::Base(std::size_t round) {
  if (!base_images_[round]) {
    base_images_[round] = RenderSeeds(scene_, base_, SeedsOf(round));
  }
  return *base_images_[round];
}

// From a render that no test uses: weights that knew the noise would be a bias.
const std::vector<double>& BiasTest::Weights() {
  if (!weights_.empty()) return weights_;
  const SeedImage image = RenderSeeds(scene_, base_, {1, 1, kWeightSpp})[0];
  std::vector<double> values;
  double roots = 0;
  for (const Rgb& c : image.pixels) {
    values.push_back(std::max(0.0, (c.x + c.y + c.z) / 3));
    roots += std::sqrt(values.back()) / double(image.pixels.size());
  }
  // The square of the mean root: a few lamps do not rule it.
  const double darkest = std::max(kDarkest * roots * roots, 1e-30);
  for (const double value : values) weights_.push_back(1 / (value + darkest));
  return weights_;
}

std::vector<BiasTest::Finding> BiasTest::Round(
    std::size_t round, const std::vector<SeedImage>& images,
    const std::optional<std::vector<Finding>>& before, BiasVerdict& verdict) {
  const std::vector<SeedImage>& bases = Base(round);
  ++verdict.rounds;
  const std::vector<Place> places = PlacesOf(images[0].width, images[0].height, tile_);
  std::vector<stat::MeanEstimate> tests = DifferencesOf(places, images, bases, Weights());
  SetVariances((images[0].width + tile_ - 1) / tile_, tests);
  const double level = rounds_[round].level;
  if (round == 0) {
    verdict.tests = static_cast<int>(tests.size());
    verdict.tile_power = Power({tests.begin(), tests.end() - 3}, level);
    verdict.image_power = Power({tests.end() - 3, tests.end()}, level);
  }
  std::vector<Finding> asked;
  if (before) {
    asked = *before;
  } else {
    for (std::size_t t = 0; t < tests.size(); ++t)
      asked.push_back({t, tests[t].mean > 0});
  }
  std::vector<Finding> found;
  double minimum = 2;
  for (const Finding& one : asked) {
    const stat::MeanEstimate& d = tests[one.test];
    if ((d.mean > 0) != one.brighter) continue;
    const double p = PValue(d);
    if (p < level) found.push_back(one);
    if (p >= minimum) continue;
    minimum = p;
    const Place& place = places[one.test / 3];
    verdict.worst = fmt::format(
        "[{},{})x[{},{}) channel {}: {:+.3f} % +- {:.3f} %, p {:.2g}", place.x0, place.x1,
        place.y0, place.y1, one.test % 3, 100 * d.mean, 100 * std::sqrt(d.variance), p);
  }
  return found;
}

BiasVerdict BiasTest::Compare(const std::string& strategy) {
  return CompareImages(
      [&](const SeedRange& seeds) { return RenderSeeds(scene_, strategy, seeds); });
}

}  // namespace lanelight::test
