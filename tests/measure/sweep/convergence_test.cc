// Curves of error against samples with known causes: where the error stops falling as
// 1 / N, the page says why and names the pixels. Clean curves are not blamed.
#include "src/measure/sweep/convergence.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace lanelight {
namespace {

constexpr int kWidth = 20, kHeight = 15;
constexpr std::size_t kPixel = 4 * kWidth + 7;

struct Known {
  double noise = 0.3;   // of one sample, over the mean
  double floor = 0;     // noise of a seed that no number of samples removes
  double odd = 0;       // of one sample of the pixel (7, 4); 0: like others
  double pareto = 0;    // exponent of samples of that pixel; 0: normal ones
  bool half = false;    // images are rounded to 11 significant bits
  double decay = 1;     // variances fall as N^-decay
  bool nested = false;  // images of a seed share the samples of smaller counts
  std::size_t seeds = 4;
  std::vector<double> samples = {4, 16, 64, 256, 1024};
};

float RoundedToHalf(double x) {
  const double spacing = std::ldexp(1, std::ilogb(x) - 10);
  return float(std::round(x / spacing) * spacing);
}

double ParetoMean(double exponent, double count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform;
  double sum = 0;
  for (int i = 0; i < int(count); ++i)
    sum += std::pow(1 - uniform(random), -1 / exponent);
  return sum / count;
}

LinearImage ImageOf(const Known& known, double samples, std::mt19937& random) {
  std::normal_distribution<double> normal;
  LinearImage image{kWidth, kHeight, {}};
  for (Plane& plane : image.planes) plane.resize(image.pixels());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const double mean = 0.2 + 0.01 * double(i);
    const double one = i == kPixel && known.odd > 0 ? known.odd : known.noise;
    const double noise =
        mean * std::hypot(one / std::pow(samples, known.decay / 2), known.floor);
    for (Plane& plane : image.planes) {
      const double x = mean + noise * normal(random);
      plane[i] = known.half ? RoundedToHalf(x) : float(x);
    }
  }
  if (known.pareto > 0) {
    const auto value = float(ParetoMean(known.pareto, samples, random));
    for (Plane& plane : image.planes) plane[kPixel] = value;
  }
  return image;
}

// Replaces a fraction of an image by another one.
void Mix(const LinearImage& other, float fraction, LinearImage& image) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      float& x = image.planes[c][i];
      x += fraction * (other.planes[c][i] - x);
    }
  }
}

Convergence Analyse(const Known& known, unsigned seed) {
  std::mt19937 random(seed);
  ErrorCurve curve = {known.samples, known.seeds, known.half, {}};
  std::map<std::pair<std::size_t, std::size_t>, LinearImage> images;
  for (std::size_t i = 0; i < known.samples.size(); ++i) {
    const double before = known.nested && i > 0 ? known.samples[i - 1] : 0;
    for (std::size_t s = 0; s < known.seeds; ++s) {
      LinearImage& image = images[{i, s}];
      image = ImageOf(known, known.samples[i] - before, random);
      if (before > 0) Mix(images[{i - 1, s}], float(before / known.samples[i]), image);
    }
  }
  curve.image = [&](std::size_t i, std::size_t s) { return images.at({i, s}); };
  return AnalyseCurve(curve);
}

// Counts the curves of 100 that are blamed.
int Blamed(const Known& known) {
  int blamed = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Convergence c = Analyse(known, seed);
    blamed += c.fall == Fall::kSlower || c.cause != FallCause::kNone;
  }
  return blamed;
}

}  // namespace

TEST_CASE("sweep convergence: curves that fall as 1/N or faster are not blamed",
          "[sweep]") {
  CHECK(Blamed({}) <= 5);
  CHECK(Blamed({.seeds = 8}) <= 5);
  CHECK(Blamed({.nested = true}) <= 5);
  CHECK(Blamed({.odd = 8, .nested = true, .seeds = 8}) <= 5);
  CHECK(Blamed({.decay = 1.5}) == 0);
  CHECK(Blamed({.odd = 8}) <= 5);  // carries most of the error, but has no heavy tails
  CHECK(Blamed({.odd = 8, .seeds = 8}) <= 5);
  CHECK(Analyse({.odd = 8}, 1).worst_share > 0.4);
  const Convergence c = Analyse({}, 1);
  CHECK(c.fall == Fall::kAsExpected);
  CHECK(c.order.Contains(1));
  REQUIRE(c.relmse.size() == 5);
  CHECK(c.relmse[2].value == Approx(0.09 / 64).epsilon(0.1));
  CHECK(c.worst_share < 0.05);
}

TEST_CASE("sweep convergence: the count where a curve stops falling", "[sweep]") {
  // Equal variances at 64 samples: steps beyond fall ever more slowly.
  const Convergence c = Analyse({.floor = 0.3 / 8}, 2);
  CHECK(c.fall == Fall::kSlower);
  CHECK(c.samples[c.from] >= 16);
  CHECK(c.samples[c.from] <= 64);
  CHECK(c.cause == FallCause::kUnknown);
  CHECK(c.orders.back().high < 0.3);
  CHECK(c.orders.front().Contains(1 - std::log(1.25 / 1.0625) / std::log(4)));
}

TEST_CASE("sweep convergence: rounding of half floats is found", "[sweep]") {
  const Convergence c = Analyse(
      {.noise = 0.01, .half = true, .samples = {16, 64, 256, 1024, 4096, 16384}}, 3);
  CHECK(c.fall == Fall::kSlower);
  CHECK(c.cause == FallCause::kRounding);
  CHECK(c.samples[c.from] >= 256);
  // Where rounding dominates already, no slower fall is needed.
  const Convergence early =
      Analyse({.noise = 0.01, .half = true, .samples = {64, 256, 1024}}, 3);
  CHECK(early.cause == FallCause::kRounding);
  // Spacings of 2^-10 to 2^-11 of a value, less for the weight of dark pixels.
  CHECK(c.rounding > 1e-8);
  CHECK(c.rounding < 8e-8);
  const Convergence fine =
      Analyse({.noise = 0.01, .samples = {16, 64, 256, 1024, 4096, 16384}}, 3);
  CHECK(fine.fall == Fall::kAsExpected);
}

TEST_CASE("sweep convergence: a pixel with heavy tails is named", "[sweep]") {
  int blamed = 0, named = 0, repeated = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Convergence c = Analyse({.pareto = 1.2, .seeds = 8}, seed);
    blamed += c.cause == FallCause::kHeavyTails;
    REQUIRE_FALSE(c.pixels.empty());
    named += c.pixels[0].x == 7 && c.pixels[0].y == 4 && c.pixels[0].share > 0.3;
    repeated += c.repeated > 0.8;
  }
  CHECK(blamed >= 36);
  CHECK(named >= 36);
  CHECK(repeated >= 36);
}

TEST_CASE("sweep convergence: images without noise have no order", "[sweep]") {
  const Convergence c = Analyse({.noise = 0}, 5);
  CHECK(c.fall == Fall::kExact);
  CHECK(c.cause == FallCause::kNone);
}

}  // namespace lanelight
