// control=regression: the fit removes the share of f that is quadratic in the numbers of
// the first bounce, from later samples only, so that the mean stays.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "src/image/regression_film.h"

namespace lanelight {
namespace {

constexpr int kFirst = 3;  // plane of the numbers, after the colours
constexpr int kPlanes = kFirst + RegressionFilm::kPlanes;

// One rectangle of pixels with its samples in a buffer as the engine's tasks have.
struct Buffer {
  int width, height;
  std::uint32_t count;
  std::vector<std::uint32_t> pixels;
  std::vector<float> values;

  Buffer(int w, int h, std::uint32_t n) : width(w), height(h), count(n) {
    for (int i = 0; i < w * h; ++i) pixels.push_back(static_cast<std::uint32_t>(i));
    values.resize(static_cast<std::size_t>(w * h * kPlanes) * n);
  }
  SampleBlock Block() {
    return {0,
            0,
            width,
            height,
            pixels.data(),
            static_cast<std::uint32_t>(pixels.size()),
            static_cast<std::uint32_t>(width),
            values.data(),
            count};
  }
  float& At(int plane, std::uint32_t pixel, std::uint32_t sample) {
    return Block().At(plane, pixel)[sample];
  }
};

// f(u) = (u0 + u2)^2 + u1^2: mean 7/6 + 1/3 = 3/2, skewed, and no polynomial in the basis
// (the product u0 u2 is not). Sample `i` of group i / group repeats with jitter: samples
// of a group depend on each other.
Buffer Simulate(int side, std::uint32_t count, std::uint32_t group, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  Buffer out(side, side, count);
  for (std::uint32_t p = 0; p < out.pixels.size(); ++p) {
    float shift[RegressionFilm::kPlanes] = {};
    for (std::uint32_t i = 0; i < count; ++i) {
      float u[RegressionFilm::kPlanes];
      for (int k = 0; k < RegressionFilm::kPlanes; ++k) {
        if (i % group == 0) shift[k] = uniform(engine);
        u[k] = shift[k] + float(i % group) / float(group);
        u[k] -= std::floor(u[k]);
        out.At(kFirst + k, p, i) = u[k];
      }
      const float f = (u[0] + u[2]) * (u[0] + u[2]) + u[1] * u[1];
      for (int c = 0; c < 3; ++c) out.At(c, p, i) = f;
    }
  }
  return out;
}
constexpr double kMean = 1.5;

double Mean(Buffer& b, std::uint32_t pixel, int plane = 0) {
  double sum = 0;
  for (std::uint32_t i = 0; i < b.count; ++i) sum += double(b.At(plane, pixel, i));
  return sum / b.count;
}

// The mean of the pixel with a fit to the same samples: what must not be done.
double SelfFitted(Buffer& b, std::uint32_t pixel) {
  const double mean = Mean(b, pixel), n = b.count;
  double products[RegressionFilm::kFunctions] = {}, sums[RegressionFilm::kFunctions] = {};
  for (std::uint32_t i = 0; i < b.count; ++i) {
    float u[RegressionFilm::kPlanes], phi[RegressionFilm::kFunctions];
    for (int k = 0; k < RegressionFilm::kPlanes; ++k) u[k] = b.At(kFirst + k, pixel, i);
    RegressionFilm::Functions(u, phi);
    for (int j = 0; j < RegressionFilm::kFunctions; ++j) {
      products[j] += (double(b.At(0, pixel, i)) - mean) * double(phi[j]) / n;
      sums[j] += double(phi[j]) / n;
    }
  }
  double corrected = mean;
  for (int j = 0; j < RegressionFilm::kFunctions; ++j) corrected -= products[j] * sums[j];
  return corrected;
}

double ZScore(const std::vector<double>& values, double truth) {
  double sum = 0, squares = 0;
  for (double v : values) sum += v, squares += v * v;
  const double n = double(values.size()), mean = sum / n;
  return (mean - truth) / std::sqrt((squares / n - mean * mean) / (n - 1));
}

}  // namespace

TEST_CASE("regression: the functions are orthonormal with mean 0", "[control]") {
  constexpr int kSteps = 4000;
  double mean[4] = {}, square[4] = {}, product = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float u = (float(i) + 0.5f) / kSteps;
    const float numbers[] = {u, 0.5f, -1, 0.5f, u, 0.5f};
    float phi[RegressionFilm::kFunctions];
    RegressionFilm::Functions(numbers, phi);
    const double values[] = {phi[0], phi[1], phi[8], phi[4]};
    for (int k = 0; k < 4; ++k) {
      mean[k] += values[k] / kSteps;
      square[k] += values[k] * values[k] / kSteps;
    }
    product += values[0] * values[1] / kSteps;
    CHECK(phi[5] == 0);  // a path without a light sample
  }
  for (double m : mean) CHECK(std::abs(m) < 1e-5);
  for (int k = 0; k < 3; ++k) CHECK(square[k] == Approx(1).epsilon(1e-4));
  CHECK(std::abs(product) < 1e-5);
}

TEST_CASE("regression: unbiased where a fit to the same samples is not", "[control]") {
  for (std::uint32_t group : {1u, 4u}) {
    std::vector<double> corrected, plain, self;
    // Few samples: the first fits, which are the worst.
    for (unsigned seed = 0; seed < 60; ++seed) {
      Buffer b = Simulate(16, 24, group, 100 * group + seed);
      for (std::uint32_t p = 0; p < 256; ++p) {
        plain.push_back(Mean(b, p));
        self.push_back(SelfFitted(b, p));
      }
      RegressionFilm film(0, 0, 16, 16, group, 1);
      film.Correct(b.Block(), kFirst);
      for (std::uint32_t p = 0; p < 256; ++p) corrected.push_back(Mean(b, p));
    }
    INFO("groups of " << group);
    CHECK(std::abs(ZScore(plain, kMean)) < 5.5);
    CHECK(std::abs(ZScore(corrected, kMean)) < 5.5);
    if (group == 1) CHECK(std::abs(ZScore(self, kMean)) > 11);
  }
}

TEST_CASE("regression: what the fit explains goes away", "[control]") {
  Buffer b = Simulate(8, 512, 1, 9);
  RegressionFilm film(0, 0, 8, 8, 1, 1);
  film.Correct(b.Block(), kFirst);
  double squares = 0;
  const std::uint32_t late = 128;
  for (std::uint32_t i = late; i < b.count; ++i) {
    for (std::uint32_t p = 0; p < 64; ++p) {
      const double d = double(b.At(0, p, i)) - kMean;
      squares += d * d / ((b.count - late) * 64);
    }
  }
  // Left over: 2 (u0 - 1/2) (u2 - 1/2), of variance 4 / 144.
  CHECK(squares == Approx(4.0 / 144).epsilon(0.1));
  CHECK(film.Report().correlation > 0.95);
  CHECK(film.Report().coefficient == 1);
}

TEST_CASE("regression: samples never see their own group", "[control]") {
  const std::uint32_t group = 6;  // fits at multiples of 12
  Buffer a = Simulate(4, 60, group, 4), b = a;
  const Buffer original = a;
  for (int c = 0; c < 3; ++c) b.At(c, 5, 30) += 100;
  RegressionFilm of_a(0, 0, 4, 4, group, 1), of_b(0, 0, 4, 4, group, 1);
  of_a.Correct(a.Block(), kFirst);
  of_b.Correct(b.Block(), kFirst);
  bool later_differ = false;
  for (std::uint32_t p = 0; p < 16; ++p) {
    for (std::uint32_t i = 0; i < 60; ++i) {
      const bool same = a.At(0, p, i) == b.At(0, p, i);
      if (p == 5 && i == 30) continue;
      if (i < 36) CHECK(same);  // the group of sample 30 and its block end there
      later_differ |= !same;
      if (i < 12) CHECK(a.At(0, p, i) == const_cast<Buffer&>(original).At(0, p, i));
    }
  }
  CHECK(later_differ);
}

TEST_CASE("regression: how samples are cut into tasks does not matter", "[control]") {
  Buffer whole = Simulate(4, 50, 1, 6), source = whole;
  RegressionFilm of_whole(0, 0, 4, 4, 1, 0.7), of_parts(0, 0, 4, 4, 1, 0.7);
  of_whole.Correct(whole.Block(), kFirst);
  std::uint32_t first = 0;
  for (std::uint32_t count : {3u, 5u, 29u, 13u}) {
    Buffer part(4, 4, count);
    for (std::uint32_t p = 0; p < 16; ++p) {
      for (int plane = 0; plane < kPlanes; ++plane) {
        for (std::uint32_t i = 0; i < count; ++i) {
          part.At(plane, p, i) = source.At(plane, p, first + i);
        }
      }
    }
    of_parts.Correct(part.Block(), kFirst);
    for (std::uint32_t p = 0; p < 16; ++p) {
      for (std::uint32_t i = 0; i < count; ++i) {
        REQUIRE(part.At(1, p, i) == whole.At(1, p, first + i));
      }
    }
    first += count;
  }
}

}  // namespace lanelight
