// Radiance in any unit: error estimates and comparisons are the same, but for the epsilon
// of the relative error.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "src/base/image/image.h"
#include "src/measure/compare/metrics.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

constexpr int kSide = 24;
constexpr std::uint32_t kSamples = 8;

// Pixels of different brightness, times 2^exponent.
FilmAccumulator NoisyFilm(int exponent) {
  FilmAccumulator film(0, 0, kSide, kSide, SampleGroups{}, Auxiliary::kNone);
  std::mt19937 random(3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      float values[3][kSamples];
      for (auto& plane : values) {
        for (float& v : plane) {
          // Without std::uniform_real_distribution, whose values are the library's.
          const double u = random() / 4294967296.0;
          v = static_cast<float>(std::ldexp(std::exp(0.1 * (x + y)) * u * u, exponent));
        }
      }
      const float* const planes[3] = {values[0], values[1], values[2]};
      film.AddSamples(x, y, planes, kSamples);
    }
  }
  return film;
}

void CheckScaled(const Interval& a, const Interval& b, double factor) {
  CHECK(b.value == Approx(a.value * factor).epsilon(1e-6));
  CHECK(b.low == Approx(a.low * factor).epsilon(1e-6));
  CHECK(b.high == Approx(a.high * factor).epsilon(1e-6));
}

// Radiance and variance as files hold them.
Image FilmFile(const FilmAccumulator& film, int exponent) {
  Image image =
      MakeImage(kSide, kSide, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.At(x, y, c) = static_cast<float>(film.Mean(x, y)[c]);
        image.At(x, y, 3 + c) =
            static_cast<float>(std::ldexp(film.Variance(x, y)[c], -exponent));
      }
    }
  }
  if (exponent != 0) image.attributes[kVarianceExponent] = exponent;
  return image;
}

}  // namespace

TEST_CASE("estimates: a larger unit gives the same relative error", "[estimate]") {
  // The epsilon is 1e-2 against squares of 1e12 and more.
  const ErrorEstimate one = EstimateError(NoisyFilm(20));
  REQUIRE(one.available);
  for (const int exponent : {40, 80, 100, 120}) {
    INFO(exponent);
    const ErrorEstimate other = EstimateError(NoisyFilm(exponent));
    CHECK(other.available);
    CHECK(other.has_interval == one.has_interval);
    CheckScaled(one.relmse, other.relmse, 1);
    CheckScaled(one.rmse, other.rmse, std::ldexp(1.0, exponent - 20));
    CHECK(other.effective_pixels == Approx(one.effective_pixels).epsilon(1e-6));
  }
}

TEST_CASE("estimates: a smaller unit scales both errors", "[estimate]") {
  // The epsilon is all that the relative error divides by.
  const ErrorEstimate one = EstimateError(NoisyFilm(-30));
  for (const int exponent : {-60, -90, -110}) {
    INFO(exponent);
    const ErrorEstimate other = EstimateError(NoisyFilm(exponent));
    REQUIRE(other.available);
    CheckScaled(one.rmse, other.rmse, std::ldexp(1.0, exponent + 30));
    CheckScaled(one.relmse, other.relmse, std::ldexp(1.0, 2 * (exponent + 30)));
  }
}

TEST_CASE("compare: variances in another unit are the same variances", "[estimate]") {
  const FilmAccumulator film = NoisyFilm(0);
  const Image plain = FilmFile(film, 0), other = FilmFile(film, 37);
  Image reference = plain;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (i % 6 < 3) reference.pixels[i] *= 1.25f;
  }
  const ZScores a = CompareImages(plain, reference).z;
  for (const auto& [test, truth] : {std::pair(other, reference), {reference, other}}) {
    const ZScores b = CompareImages(test, truth).z;
    REQUIRE(b.count == a.count);
    CHECK(std::abs(b.mean) == Approx(std::abs(a.mean)).epsilon(1e-5));
    CHECK(b.standard_deviation == Approx(a.standard_deviation).epsilon(1e-5));
  }
}

TEST_CASE("variances are written in units that hold them", "[estimate]") {
  for (const double ordinary : {0.0, 1e-18, 1e-9, 1.0, 1e9, 8e37}) {
    CHECK(VarianceExponent(ordinary) == 0);
  }
  for (const double extreme : {8e-19, 1e-40, 1e-62, 1e-90, 9e37, 1e60, 1e77}) {
    INFO(extreme);
    const int exponent = VarianceExponent(extreme);
    CHECK(exponent != 0);
    const float stored = static_cast<float>(std::ldexp(extreme, -exponent));
    CHECK(std::isfinite(stored));
    CHECK(stored > 1e37f);
    Image image = MakeImage(1, 1, {"R"});
    CHECK(VarianceUnit(image) == 1);
    image.attributes[kVarianceExponent] = exponent;
    CHECK(stored * VarianceUnit(image) == Approx(extreme).epsilon(1e-6));
  }
  CHECK(VarianceExponent(INFINITY) == 0);
  CHECK(VarianceExponent(NAN) == 0);
}

}  // namespace lanelight
