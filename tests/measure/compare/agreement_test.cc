// Decides whether renders agree within their noise: planted differences are found, noise
// alone is not called one more often than is said.
#include "src/measure/compare/agreement.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "src/base/image/image.h"

namespace lanelight {
namespace {

constexpr int kWide = 64, kHigh = 48;

// Smooth light with noise of `observations` normal ones in each pixel, and the variances
// estimated from them.
struct NoisyRender {
  std::mt19937 random;
  int observations = 4;
  double deviation = 0.3;
  double rare = 0;  // chance of an observation that is 200 times brighter

  Image Make() {
    Image image = MakeImage(kWide, kHigh,
                            {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        for (int c = 0; c < 3; ++c) Fill(image, x, y, c);
      }
    }
    image.attributes[kObservations] = observations;
    return image;
  }

  void Fill(Image& image, int x, int y, int c) {
    std::normal_distribution<double> normal(1, deviation);
    std::uniform_real_distribution<double> uniform;
    double sum = 0, squares = 0;
    for (int i = 0; i < observations; ++i) {
      double v = (0.5 + 0.01 * x + 0.1 * c) * normal(random);
      if (uniform(random) < rare) v += 200 * std::abs(v);
      sum += v, squares += v * v;
    }
    const double n = observations, mean = sum / n;
    image.At(x, y, c) = static_cast<float>(mean);
    image.At(x, y, c + 3) = static_cast<float>((squares / n - mean * mean) / (n - 1));
  }
};

// Multiplies the colours in a rectangle.
void Brighten(Image& image, double factor, int x0, int y0, int x1, int y1, int channel) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      image.At(x, y, channel) *= static_cast<float>(factor);
    }
  }
}

}  // namespace

TEST_CASE("renders that differ by noise alone agree", "[agreement]") {
  // 200 pairs, each with a false alarm of 0.001: more than 3 have a chance of 6e-5.
  NoisyRender render = {std::mt19937(1)};
  int alarms = 0;
  for (int pair = 0; pair < 200; ++pair) {
    const Agreement a = TestAgreement(render.Make(), render.Make(), false);
    REQUIRE(a.verdict != AgreementVerdict::kInconclusive);
    CHECK(a.untested == 0);
    CHECK(a.tests == 3 * (a.layout.size() + 1));
    CHECK((a.p <= a.level) == (a.verdict == AgreementVerdict::kDiffer));
    alarms += a.verdict == AgreementVerdict::kDiffer;
  }
  CHECK(alarms <= 3);
}

TEST_CASE("rare bright samples raise no alarm", "[agreement]") {
  // As above; a few pixels of each image hold most of its light.
  NoisyRender render = {std::mt19937(2), 4, 0.3, 1e-4};
  int alarms = 0;
  for (int pair = 0; pair < 200; ++pair) {
    alarms += TestAgreement(render.Make(), render.Make(), false).verdict ==
              AgreementVerdict::kDiffer;
  }
  CHECK(alarms <= 3);
}

TEST_CASE("differences beyond noise are found, and where they are", "[agreement]") {
  NoisyRender render = {std::mt19937(3)};
  const Image reference = render.Make();
  SECTION("of the whole") {
    Image image = render.Make();
    Brighten(image, 1.02, 0, 0, kWide, kHigh, 0);
    const Agreement a = TestAgreement(image, reference, false);
    CHECK(a.verdict == AgreementVerdict::kDiffer);
    CHECK(a.image_failed);
    CHECK(a.p < 1e-3);
  }
  SECTION("of a tile, in one channel") {
    Image image = render.Make();
    Brighten(image, 1.3, 8, 16, 16, 24, 2);
    const Agreement a = TestAgreement(image, reference, false);
    REQUIRE(a.layout.side == 8);
    CHECK(a.failed == std::vector<std::size_t>{a.layout.At(8, 16)});
    CHECK(a.z[a.layout.At(8, 16)] > 4);
  }
  SECTION("half as large as those that are found in half of the cases") {
    Image image = render.Make();
    const Agreement clean = TestAgreement(image, reference, false);
    CHECK(clean.detectable > 0.005);
    CHECK(clean.detectable < 0.03);
    for (int c = 0; c < 3; ++c) {
      Brighten(image, 1 + 2.5 * clean.detectable, 0, 0, kWide, kHigh, c);
    }
    CHECK(TestAgreement(image, reference, false).image_failed);
  }
}

TEST_CASE("images without variances are inconclusive", "[agreement]") {
  NoisyRender render = {std::mt19937(4)};
  const Image noisy = render.Make();
  Image plain = MakeImage(kWide, kHigh, {"R", "G", "B"});
  const auto why = [](const Image& a, const Image& b, bool exact) {
    const Agreement agreement = TestAgreement(a, b, exact);
    CHECK(std::isnan(agreement.p));
    CHECK(agreement.verdict == AgreementVerdict::kInconclusive);
    return agreement.why;
  };
  CHECK(why(plain, plain, false) == "neither image has variances");
  CHECK(why(plain, noisy, false) == "the first image has no variances");
  CHECK(why(plain, noisy, true) == "the first image has no variances");
  CHECK_THAT(why(noisy, plain, false), Catch::Contains("--reference"));
  CHECK(TestAgreement(noisy, plain, true).verdict == AgreementVerdict::kDiffer);
}

TEST_CASE("pixels that have paths in common count as fewer", "[agreement]") {
  NoisyRender render = {std::mt19937(5)};
  const Image reference = render.Make();
  Image image = render.Make();
  Brighten(image, 1.02, 0, 0, kWide, kHigh, 0);
  REQUIRE(TestAgreement(image, reference, false).image_failed);
  image.attributes[kDependentPixels] = 17.0;
  const Agreement a = TestAgreement(image, reference, false);
  CHECK_FALSE(a.image_failed);
  CHECK(a.detectable > 0.04);
}

TEST_CASE("equal seeds and equally rounded half floats are reported", "[agreement]") {
  NoisyRender render = {std::mt19937(6), 4, 0};
  Image image = render.Make(), reference = image;
  image.attributes["seed"] = reference.attributes["seed"] = std::string("7");
  CHECK_THAT(TestAgreement(image, reference, false).caveat, Catch::Contains("seed 7"));
  // 1e-4 below, without noise: rounding to half floats may do that, to floats may not.
  for (int c = 0; c < 3; ++c) Brighten(image, 1 - 1e-4, 0, 0, kWide, kHigh, c);
  for (int c = 3; c < 6; ++c) {
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) image.At(x, y, c) = reference.At(x, y, c) = 0;
    }
  }
  CHECK(TestAgreement(image, reference, false).verdict == AgreementVerdict::kDiffer);
  for (int c = 0; c < 3; ++c) Brighten(reference, 0, 0, 0, kWide, kHigh, c);
  for (float& v : reference.pixels) v += 0.5f;
  Image close = reference;
  for (int c = 0; c < 3; ++c) Brighten(close, 1 - 1e-4, 0, 0, kWide, kHigh, c);
  for (Image* one : {&close, &reference}) {
    for (int c = 3; c < 6; ++c) Brighten(*one, 0, 0, 0, kWide, kHigh, c);
  }
  CHECK(TestAgreement(close, reference, false).verdict == AgreementVerdict::kAgree);
}

}  // namespace lanelight
