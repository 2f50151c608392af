// The error estimate predicts the error of this very image: its interval contains the
// true error as often as it says, on simulated images whose true error is known, whatever
// the distribution of the samples; and estimates with a mistake in them do not.
#include "src/render/estimate/estimate.h"

#include <atomic>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace lanelight {
namespace {

using Noise = std::function<double(std::mt19937_64&)>;  // mean 0, variance 1

double Normal(std::mt19937_64& random) {
  return std::normal_distribution<double>()(random);
}
double Exponential(std::mt19937_64& random) {
  return std::exponential_distribution<double>()(random) - 1;
}
// One sample in twenty is bright.
double Rare(std::mt19937_64& random) {
  constexpr double kRate = 0.05;
  const double x = std::uniform_real_distribution<double>()(random) < kRate ? 1 : 0;
  return (x - kRate) / std::sqrt(kRate * (1 - kRate));
}

struct SimulatedImage {
  int width = 24, height = 16, groups = 16;
  double deviation = 0.5;  // of a group's mean, relative to the pixel's
  Noise noise = Normal;
  int copies = 1;      // of each group: dependent observations
  bool equal = false;  // all pixels have the same mean
  int lamp = -1;       // column that a lamp covers a part of, if any; on its right all

  static constexpr double kLamp = 17;
  double Covered(int x, int y) const {
    return x == lamp ? (y + 1) / (4.0 * height) : double(x > lamp);
  }
  double Mean(int x, int y) const {
    const double floor = equal ? 0.3 : 0.1 + 0.03 * x + 0.01 * y;
    return lamp < 0 ? floor : floor + Covered(x, y) * (kLamp - floor);
  }
  double Sample(int x, int y, std::mt19937_64& random) const {
    if (x != lamp || lamp < 0) return Mean(x, y) * (1 + deviation * noise(random));
    const double u = std::uniform_real_distribution<double>()(random);
    return u < Covered(x, y) ? kLamp : (equal ? 0.3 : 0.1 + 0.03 * x + 0.01 * y);
  }

  // Draws what `copies` > 1 wrongly counts as independent.
  PixelEstimate Draw(int x, int y, std::mt19937_64& random) const {
    double sum = 0, squares = 0;
    for (int g = 0; g < groups; ++g) {
      const double v = Sample(x, y, random);
      sum += copies * v;
      squares += copies * v * v;
    }
    const double n = double(groups) * copies, mean = sum / n;
    const double variance = std::max(0.0, squares / n - mean * mean) / (n - 1);
    PixelEstimate p;
    p.known = true;
    p.freedom = n - 1;
    for (int c = 0; c < 3; ++c) p.mean[c] = mean, p.variance[c] = variance;
    return p;
  }

  struct Drawn {
    std::vector<PixelEstimate> pixels;
    double mse = 0, relmse = 0;  // true
    double plain = 0;            // estimate that divides by the means as they are
  };
  Drawn DrawAll(std::mt19937_64& random) const {
    Drawn out;
    const double n = double(width) * height;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        out.pixels.push_back(Draw(x, y, random));
        const double m = out.pixels.back().mean[0], truth = Mean(x, y);
        const double square = (m - truth) * (m - truth);
        out.mse += square / n;
        out.relmse += square / (truth * truth + kRelativeEpsilon) / n;
        out.plain += out.pixels.back().variance[0] / (m * m + kRelativeEpsilon) / n;
      }
    }
    return out;
  }
  ErrorEstimate Estimate(const Drawn& drawn) const {
    return EstimateError({0, 0, width, height}, [&](int x, int y) {
      return drawn.pixels[static_cast<std::size_t>(y * width + x)];
    });
  }
};

// Shares of `trials` whose intervals contain the truth.
struct Coverage {
  double rmse = 0, relmse = 0, plain = 0;
  double half = 0;     // of relmse, with intervals half as wide
  double refused = 0;  // without an interval: contains nothing
};

Coverage MeasureCoverage(const SimulatedImage& image, int trials) {
  std::mt19937_64 random(7);
  Coverage covered;
  for (int i = 0; i < trials; ++i) {
    const auto drawn = image.DrawAll(random);
    const ErrorEstimate e = image.Estimate(drawn);
    const Interval plain =
        ErrorInterval(drawn.plain, e.effective_pixels,
                      e.effective_pixels * (image.groups * image.copies - 1));
    covered.rmse += e.rmse.Contains(std::sqrt(drawn.mse)) / double(trials);
    covered.relmse += e.relmse.Contains(drawn.relmse) / double(trials);
    covered.plain += plain.Contains(drawn.relmse) / double(trials);
    covered.refused += !e.has_interval / double(trials);
    const Interval& v = e.relmse;
    const Interval half = {v.value, std::sqrt(v.low * v.value),
                           std::sqrt(v.high * v.value)};
    covered.half += half.Contains(drawn.relmse) / double(trials);
  }
  return covered;
}

// A coverage of 0.93 or more gives less than this in 150 trials once in 10^6 times
// (binomial distribution); mistakes give much less.
constexpr int kTrials = 150;
constexpr double kMinCoverage = 0.81;

}  // namespace

TEST_CASE("intervals contain the true error for any distribution", "[study]") {
  for (const Noise& noise : {Noise(Normal), Noise(Exponential), Noise(Rare)}) {
    for (int groups : {4, 16, 64}) {
      SimulatedImage image;
      image.noise = noise;
      image.groups = groups;
      const Coverage honest = MeasureCoverage(image, kTrials);
      INFO(groups << " groups");
      CHECK(honest.rmse >= kMinCoverage);
      CHECK(honest.relmse >= kMinCoverage);
    }
  }
}

TEST_CASE("the interval includes light edges that few samples hit", "[study]") {
  SimulatedImage image;
  image.lamp = 11;
  image.deviation = 0.2;
  for (int groups : {16, 64}) {
    image.groups = groups;
    const Coverage c = MeasureCoverage(image, kTrials);
    INFO(groups << " groups");
    CHECK(c.relmse + c.refused >= kMinCoverage);
    CHECK(c.refused < 0.2);
    CHECK(c.half + c.refused < kMinCoverage);
  }
}

TEST_CASE("the interval is valid for noise as large as the image", "[study]") {
  SimulatedImage image;
  image.noise = Rare;
  image.deviation = 4;
  image.groups = 4;
  image.equal = true;
  image.width = 48, image.height = 32;
  const Coverage c = MeasureCoverage(image, kTrials);
  CHECK(c.relmse >= kMinCoverage);
  CHECK(c.refused == 0);
}

TEST_CASE("one bright sample leaves its pixel's value uncertain", "[study]") {
  SimulatedImage image;
  image.equal = true;
  std::mt19937_64 random(5);
  auto drawn = image.DrawAll(random);
  CHECK(image.Estimate(drawn).why.empty());
  CHECK(image.Estimate(drawn).has_interval);
  constexpr double kBright = 8;
  PixelEstimate& pixel = drawn.pixels[40];
  const double own = std::pow(pixel.mean[0] - 0.3, 2) / (0.3 * 0.3 + kRelativeEpsilon);
  for (int c = 0; c < 3; ++c)
    pixel.mean[c] = kBright, pixel.variance[c] = kBright * kBright;
  const ErrorEstimate e = image.Estimate(drawn);
  CHECK(e.has_interval);
  const double n = double(drawn.pixels.size()), rest = drawn.relmse - own / n;
  CHECK(e.relmse.Contains(rest));  // its mean is what was seen
  const double dark = std::pow(kBright - 0.3, 2) / (0.3 * 0.3 + kRelativeEpsilon);
  CHECK(e.relmse.Contains(rest + dark / n));  // its mean is its neighbours'
}

TEST_CASE("no interval is printed when the sample is too small", "[study]") {
  // A lamp of the size of a pixel; one sample of the pixel beside it has met it too.
  SimulatedImage image;
  image.equal = true;
  image.deviation = 0.02;
  std::mt19937_64 random(5);
  auto drawn = image.DrawAll(random);
  PixelEstimate* const beside =
      &drawn.pixels[static_cast<std::size_t>(8 * image.width + 11)];
  for (int c = 0; c < 3; ++c) {
    beside[0].mean[c] = 20, beside[0].variance[c] = 400;
    beside[1].mean[c] = 30, beside[1].variance[c] = 0.01;
  }
  const ErrorEstimate e = image.Estimate(drawn);
  CHECK_FALSE(e.has_interval);
  CHECK_FALSE(e.relmse.HasBounds());
  CHECK(std::isinf(e.relmse.high));
  CHECK(e.relmse.low > 0);
  CHECK(e.relmse.low < e.relmse.value);
  CHECK(e.rmse.HasBounds());  // has no weights to be wrong about
  CHECK(e.why.find("pixel (11, 8)") != std::string::npos);
  // As many more samples as it says do give one: a hit becomes many, the mean stays.
  const std::size_t at = e.why.find("about ");
  REQUIRE(at != std::string::npos);
  const double times = std::stod(e.why.substr(at + 6));
  CHECK(times > 1);
  for (PixelEstimate& p : drawn.pixels) p.variance = p.variance / times;
  CHECK(image.Estimate(drawn).has_interval);
  for (PixelEstimate& p : drawn.pixels) p.variance = p.variance * 4.0;
  CHECK_FALSE(image.Estimate(drawn).has_interval);
}

TEST_CASE("intervals are as narrow as the data allow", "[study]") {
  // 384 equal pixels of 16 groups, channels alike: the logarithm of the ratio deviates
  // by sqrt(2/384 + 2/(384 * 15)) = 0.0745.
  SimulatedImage image;
  image.equal = true;
  std::mt19937_64 random(3);
  const ErrorEstimate e = image.Estimate(image.DrawAll(random));
  CHECK(std::log(e.rmse.high / e.rmse.low) / 2 == Approx(1.96 * 0.0745 / 2).epsilon(0.1));
  CHECK(e.effective_pixels == Approx(384).epsilon(0.2));
}

TEST_CASE("dependent samples taken for independent ones are rejected", "[study]") {
  SimulatedImage image;
  image.copies = 4;
  const Coverage wrong = MeasureCoverage(image, kTrials);
  CHECK(wrong.rmse < 0.1);
  CHECK(wrong.relmse < 0.1);
}

TEST_CASE("dividing by the noisy means themselves is rejected", "[study]") {
  SimulatedImage image;
  image.noise = Rare;
  image.deviation = 2;
  image.equal = true;
  image.width = 48, image.height = 32;
  const Coverage c = MeasureCoverage(image, kTrials);
  CHECK(c.relmse >= kMinCoverage);
  CHECK(c.plain < 0.5);
}

TEST_CASE("one pixel's error is an F variable, not a normal one", "[study]") {
  // For normal groups m and s^2 are independent, so that F(1, G - 1) is exact: its
  // interval contains the truth in 95 % of 4000 trials +- five deviations.
  SimulatedImage image;
  image.width = image.height = 1;
  image.groups = 4;
  std::mt19937_64 random(11);
  constexpr int kMany = 4000;
  int inside = 0, by_normal = 0;
  for (int i = 0; i < kMany; ++i) {
    const auto drawn = image.DrawAll(random);
    const ErrorEstimate e = image.Estimate(drawn);
    inside += e.rmse.Contains(std::sqrt(drawn.mse));
    const double value = e.rmse.value * e.rmse.value;
    by_normal += std::abs(drawn.mse - value) <= 1.96 * std::sqrt(2 + 2.0 / 3) * value;
  }
  const double slack = 5 * std::sqrt(0.95 * 0.05 / kMany);
  CHECK(std::abs(double(inside) / kMany - 0.95) < slack);
  CHECK(double(by_normal) / kMany < 0.95 - 2 * slack);
}

TEST_CASE("estimated errors equal the true ones on average", "[study]") {
  for (const Noise& noise : {Noise(Normal), Noise(Exponential)}) {
    SimulatedImage image;
    image.width = 40, image.height = 28;
    image.groups = 64;
    image.noise = noise;
    std::mt19937_64 random(1);
    double truth = 0, mse = 0, true_relmse = 0, relmse = 0;
    for (int i = 0; i < 20; ++i) {
      const auto drawn = image.DrawAll(random);
      const ErrorEstimate e = image.Estimate(drawn);
      truth += drawn.mse, mse += e.rmse.value * e.rmse.value;
      true_relmse += drawn.relmse, relmse += e.relmse.value;
    }
    // The ratio deviates by sqrt(2 / (20 * 1120)) = 0.9 % (more for unequal pixels).
    CHECK(mse == Approx(truth).epsilon(0.06));
    CHECK(relmse == Approx(true_relmse).epsilon(0.06));
  }
}

TEST_CASE("an image with pixels without a variance has no estimate", "[study]") {
  const ErrorEstimate none =
      EstimateError({0, 0, 8, 8}, [](int, int) { return PixelEstimate{}; });
  CHECK_FALSE(none.available);
  CHECK_FALSE(none.has_interval);
  const ErrorEstimate one = EstimateError({0, 0, 8, 8}, [](int x, int y) {
    PixelEstimate p;
    p.known = x == 3 && y == 2;
    p.mean = {1, 1, 1};
    p.variance = {4, 4, 4};
    p.freedom = 3;
    return p;
  });
  CHECK_FALSE(one.available);
  CHECK_FALSE(one.has_interval);
  CHECK(one.pixels == 1);
  CHECK_THAT(one.why, Catch::Contains("63 of 64 pixels"));
}

TEST_CASE("an image of one pixel has the estimate of that pixel", "[study]") {
  const ErrorEstimate one = EstimateError({3, 2, 4, 3}, [](int, int) {
    PixelEstimate p;
    p.known = true;
    p.mean = {1, 1, 1};
    p.variance = {4, 4, 4};
    p.freedom = 3;
    return p;
  });
  CHECK(one.available);
  CHECK(one.rmse.value == Approx(2));
  // The correction for skewness is undone here.
  CHECK(one.relmse.value ==
        Approx(4 / 1.01 * std::exp(kSkew * std::sqrt(kMaxSkewError))));
}

ErrorEstimate OfAllPixels(double value) {
  return EstimateError({0, 0, 5, 4}, [&](int, int) {
    PixelEstimate p;
    p.known = true;
    p.mean = {value, value, value};
    return p;
  });
}

TEST_CASE("a stopped estimate returns early without a result", "[study]") {
  std::atomic<bool> stop{false};
  std::atomic<int> calls{0};
  const auto pixel = [&](int, int y) {
    ++calls;
    if (y == 2) stop = true;
    PixelEstimate p;
    p.known = true;
    p.mean = p.variance = {1, 1, 1};
    return p;
  };
  const ErrorEstimate halfway = EstimateError({0, 0, 8, 800}, pixel, 1, &stop);
  CHECK_FALSE(halfway.available);
  CHECK(calls < 8 * 800);
  calls = 0;
  CHECK_FALSE(EstimateError({0, 0, 8, 800}, pixel, 1, &stop).available);
  CHECK(calls == 0);
}

TEST_CASE("images without noise have rounding errors only", "[study]") {
  const ErrorEstimate e = OfAllPixels(0.7);
  CHECK(e.has_interval);
  CHECK(e.rmse.value == 0);
  CHECK(e.rmse.high == Approx(0.7e-5));
  CHECK(e.relmse.value == 0);
  CHECK(e.relmse.high == Approx(1e-10 * 0.49 / 0.5).epsilon(0.05));
}

TEST_CASE("black images give no error estimate", "[study]") {
  const ErrorEstimate e = OfAllPixels(0);
  CHECK(e.available);
  CHECK_FALSE(e.has_interval);
  CHECK(e.rmse.low == 0);
  CHECK(std::isinf(e.rmse.high));
  CHECK(std::isinf(e.relmse.high));
  CHECK(e.why == kNoLight);
}

TEST_CASE("intervals are finite, positive and contain the estimate", "[study]") {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> heavy(0, 3);
  for (int i = 0; i < 20; ++i) {
    const ErrorEstimate e = EstimateError({0, 0, 17, 9}, [&](int x, int y) {
      std::mt19937_64 own(static_cast<std::uint64_t>(1000 * i + 17 * y + x));
      const double v = heavy(own);
      PixelEstimate p;
      p.known = true;
      p.mean = {std::sqrt(v), 0, 0};
      p.variance = {v, v, v};
      return p;
    });
    for (const Interval& interval : {e.relmse, e.rmse}) {
      CHECK(std::isfinite(interval.value));
      CHECK(interval.HasBounds() == std::isfinite(interval.high));
      CHECK(interval.low >= 0);
      CHECK(interval.low <= interval.value);
      CHECK(interval.value <= interval.high);
    }
  }
}

}  // namespace lanelight
