// control=regression: the fit removes the share of f that is quadratic in the numbers of
// a path's first choices. Each half of the samples is corrected by the other, so that the
// mean stays, however samples of one replicate depend on each other.
#include <catch2/catch.hpp>

#include "tests/kernels/control/regression_samples.h"

namespace lanelight {

using namespace regression_samples;

TEST_CASE("regression: unbiased, unlike a fit to the same samples", "[control]") {
  constexpr int kSide = 16;
  for (const SampleGroups& groups : kAllGroups) {
    std::vector<double> corrected, plain, self, biased;
    for (unsigned seed = 0; seed < 150; ++seed) {
      Samples s(kSide, 24, groups, 400 * groups.unit + 200 * groups.replicates + seed);
      const FilmAccumulator film = FilmOf(s, kSide, groups);
      for (int p = 0; p < s.pixels(); ++p) {
        corrected.push_back(film.Mean(p % kSide, p / kSide).x);
        plain.push_back(s.Mean(p));
        self.push_back(WronglyFitted(s, p));
        // Planted: a probability that is not that of the choice.
        for (std::uint32_t i = 0; i < s.count(); ++i) {
          float& code = s.At(kFirst + 3, p, i);
          const std::uint32_t chosen = std::bit_cast<std::uint32_t>(code) & 1;
          code = std::bit_cast<float>(ChoiceCode(1, kP - 0.05f) | chosen);
        }
      }
      const FilmAccumulator wrong = FilmOf(s, kSide, groups);
      for (int p = 0; p < s.pixels(); ++p) {
        biased.push_back(wrong.Mean(p % kSide, p / kSide).x);
      }
    }
    CAPTURE(groups.unit, groups.replicates);
    CHECK(std::abs(ZScore(plain)) < 5.5);
    CHECK(std::abs(ZScore(corrected)) < 5.5);
    CHECK(std::abs(ZScore(biased)) > 11);
    if (!groups.replicates) CHECK(std::abs(ZScore(self)) > 11);
  }
}

TEST_CASE("planted: halves that depend on each other are biased", "[control]") {
  std::vector<double> corrected;
  for (unsigned seed = 0; seed < 150; ++seed) {
    // Each replicate is torn between the halves.
    Samples s(16, 24, {2, true}, seed);
    const FilmAccumulator film = FilmOf(s, 16, {1, true});
    for (int p = 0; p < 256; ++p) corrected.push_back(film.Mean(p % 16, p / 16).x);
  }
  CHECK(std::abs(ZScore(corrected)) > 11);
}

// Mean squared error of pixels, times their samples.
double SquaredError(const FilmAccumulator& film) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const double d = film.Mean(x, y).x - kMean;
      sum += d * d * double(film.Samples(x, y)) / (film.width() * film.height());
    }
  }
  return sum;
}

TEST_CASE("regression: the explained variance is removed, and c = 1 is optimal",
          "[control]") {
  constexpr int kSide = 48;
  const SampleGroups groups = {1, false};
  Samples s(kSide, 256, groups, 9);
  const double plain = SquaredError(FilmOf(s, kSide, groups, 0));
  CHECK(plain == Approx(kPlain).epsilon(0.1));
  for (double c : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    INFO("c = " << c);
    const FilmAccumulator film = FilmOf(s, kSide, groups, c);
    // 1 - c (2 - c) R^2 of the variance, and what coefficients of 128 samples are off by:
    // d = b - fitted has sum E[d^2] = 0.034 and, as they are shrunk, sum b E[d] = 0.036,
    // by a simulation of such fits apart from this code, in double precision.
    const double expected = kLeft + (plain - kLeft) * (1 - c) * (1 - c) + c * c * 0.034 +
                            2 * c * (1 - c) * 0.036;
    CHECK(SquaredError(film) == Approx(expected).epsilon(0.12));
    double stated = 0;
    for (int p = 0; p < s.pixels(); ++p) {
      stated += film.Variance(p % kSide, p / kSide).x * 256 / s.pixels();
    }
    CHECK(stated == Approx(SquaredError(film)).epsilon(0.12));
    CHECK(film.Control()->coefficient == c);
    CHECK(film.Control()->correlation > 0.95);
  }
}

// What glass reflects of a lamp: few paths have light, and these have all the functions.
TEST_CASE("regression: fits to few paths state their error", "[control]") {
  constexpr int kSide = 64;
  constexpr float kRare = 0.05f;
  for (const std::uint32_t spp : {64u, 256u}) {
    const SampleGroups groups = {1, false};
    Samples s(kSide, spp, groups, spp);
    std::mt19937 engine(spp);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int p = 0; p < s.pixels(); ++p) {
      for (std::uint32_t i = 0; i < spp; ++i) {
        const float u = uniform(engine);
        s.At(kFirst + 3, p, i) = std::bit_cast<float>(ChoiceCode(u, kRare));
        const bool chosen = u < kRare;
        const float light = uniform(engine);
        for (int k = 1; k < 3 && !chosen; ++k) s.At(kFirst + k, p, i) = 0;
        for (int c = 0; c < 3; ++c) {
          s.At(c, p, i) = chosen ? 20 * float(kMean) * (0.5f + light) : 0;
        }
      }
    }
    const FilmAccumulator film = FilmOf(s, kSide, groups);
    double stated = 0;
    for (int p = 0; p < s.pixels(); ++p) {
      stated += film.Variance(p % kSide, p / kSide).x * spp / s.pixels();
    }
    CAPTURE(spp);
    CHECK(stated == Approx(SquaredError(film)).epsilon(0.15));
  }
}

TEST_CASE("regression: pairs and replicates state their error", "[control]") {
  for (const SampleGroups& groups : {SampleGroups{1, true}, SampleGroups{2, true}}) {
    Samples s(48, 16, groups, 3);
    const FilmAccumulator film = FilmOf(s, 48, groups);
    double stated = 0;
    for (int p = 0; p < s.pixels(); ++p) {
      stated += film.Variance(p % 48, p / 48).x * 16 / s.pixels();
    }
    CAPTURE(groups.unit);
    CHECK(stated == Approx(SquaredError(film)).epsilon(0.12));
  }
}

}  // namespace lanelight
