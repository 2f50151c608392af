// control=regression: the fit removes the share of f that is quadratic in the numbers of
// the first bounce. Each half of the samples is corrected by the other, so that the mean
// stays, however samples of one replicate depend on each other.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>
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

float Value(const float* u) { return (u[0] + u[2]) * (u[0] + u[2]) + u[1] * u[1]; }

// f(u) = (u0 + u2)^2 + u1^2: mean 7/6 + 1/3 = 3/2, skewed, and no polynomial in the basis
// (the product u0 u2 is not). The samples of a replicate, or else of a unit, depend on
// each other: each number has one of them in each stratum, in random order.
Buffer Simulate(int side, std::uint32_t count, const SampleGroups& groups,
                unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  Buffer out(side, side, count);
  const std::uint32_t most =
      groups.replicates ? static_cast<std::uint32_t>(groups.InReplicate(count, 0))
                        : groups.unit;
  std::vector<std::uint32_t> order(most);
  for (std::uint32_t p = 0; p < out.pixels.size(); ++p) {
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      for (int k = 0; k < RegressionFilm::kPlanes; ++k) {
        std::uint32_t taken = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
          if (groups.Replicate(i) != r) continue;
          if (taken % most == 0) {
            std::iota(order.begin(), order.end(), 0u);
            std::shuffle(order.begin(), order.end(), engine);
          }
          const float stratum = float(order[taken++ % most]);
          out.At(kFirst + k, p, i) =
              std::min(0x1.fffffep-1f, (stratum + uniform(engine)) / float(most));
        }
      }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      float u[RegressionFilm::kPlanes];
      for (int k = 0; k < RegressionFilm::kPlanes; ++k) u[k] = out.At(kFirst + k, p, i);
      for (int c = 0; c < 3; ++c) out.At(c, p, i) = Value(u);
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

// The mean of samples [first, last) of the pixel with a fit to samples [0, fitted): what
// must not be done.
double WronglyFitted(Buffer& b, std::uint32_t pixel, std::uint32_t fitted,
                     std::uint32_t first, std::uint32_t last) {
  double mean = 0;
  for (std::uint32_t i = 0; i < fitted; ++i) mean += double(b.At(0, pixel, i)) / fitted;
  double products[RegressionFilm::kFunctions] = {}, sums[RegressionFilm::kFunctions] = {};
  double corrected = 0;
  const double n = last - first;
  for (std::uint32_t i = 0; i < b.count; ++i) {
    float u[RegressionFilm::kPlanes], phi[RegressionFilm::kFunctions];
    for (int k = 0; k < RegressionFilm::kPlanes; ++k) u[k] = b.At(kFirst + k, pixel, i);
    RegressionFilm::Functions(u, phi);
    const double f = double(b.At(0, pixel, i));
    for (int j = 0; j < RegressionFilm::kFunctions; ++j) {
      if (i < fitted) products[j] += (f - mean) * double(phi[j]) / fitted;
      if (i >= first && i < last) sums[j] += double(phi[j]) / n;
    }
    if (i >= first && i < last) corrected += f / n;
  }
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

constexpr SampleGroups kAllGroups[] = {{1, false}, {2, false}, {1, true}, {2, true}};

TEST_CASE("regression: unbiased where a fit to the same samples is not", "[control]") {
  constexpr std::uint32_t kCount = 24;  // few: the first fits, which are the worst
  for (const SampleGroups& groups : kAllGroups) {
    std::vector<double> corrected, plain, self, earlier;
    for (unsigned seed = 0; seed < 150; ++seed) {
      Buffer b = Simulate(16, kCount, groups,
                          400 * groups.unit + 200 * groups.replicates + seed);
      for (std::uint32_t p = 0; p < 256; ++p) {
        plain.push_back(Mean(b, p));
        self.push_back(WronglyFitted(b, p, kCount, 0, kCount));
        // Samples of the past are others, but not of other replicates.
        earlier.push_back(WronglyFitted(b, p, kCount / 2, kCount / 2, kCount));
      }
      RegressionFilm film(0, 0, 16, 16, groups, 1);
      film.Correct(b.Block(), kFirst);
      for (std::uint32_t p = 0; p < 256; ++p) corrected.push_back(Mean(b, p));
    }
    CAPTURE(groups.unit, groups.replicates);
    CHECK(std::abs(ZScore(plain, kMean)) < 5.5);
    CHECK(std::abs(ZScore(corrected, kMean)) < 5.5);
    if (!groups.replicates) CHECK(std::abs(ZScore(earlier, kMean)) < 5.5);
    if (groups.replicates) CHECK(std::abs(ZScore(earlier, kMean)) > 11);
    if (groups.unit == 1 && !groups.replicates) {
      CHECK(std::abs(ZScore(self, kMean)) > 11);
    }
  }
}

TEST_CASE("planted: halves that depend on each other are biased", "[control]") {
  std::vector<double> corrected;
  for (unsigned seed = 0; seed < 150; ++seed) {
    // Each replicate is torn between the halves.
    Buffer b = Simulate(16, 24, {2, true}, seed);
    RegressionFilm film(0, 0, 16, 16, {1, true}, 1);
    film.Correct(b.Block(), kFirst);
    for (std::uint32_t p = 0; p < 256; ++p) corrected.push_back(Mean(b, p));
  }
  CHECK(std::abs(ZScore(corrected, kMean)) > 11);
}

TEST_CASE("regression: what the fit explains goes away", "[control]") {
  for (const SampleGroups& groups : {SampleGroups{1, false}, SampleGroups{2, true}}) {
    Buffer b = Simulate(8, 4096, groups, 9);
    RegressionFilm film(0, 0, 8, 8, groups, 1);
    film.Correct(b.Block(), kFirst);
    double squares = 0;
    const std::uint32_t late = 1024;
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
}

TEST_CASE("regression: samples never see their own half", "[control]") {
  constexpr std::uint32_t kCount = 60, kChanged = 30;
  for (const SampleGroups& groups : kAllGroups) {
    Buffer a = Simulate(4, kCount, groups, 4), b = a, original = a;
    for (int c = 0; c < 3; ++c) b.At(c, 5, kChanged) += 100;
    RegressionFilm of_a(0, 0, 4, 4, groups, 1), of_b(0, 0, 4, 4, groups, 1);
    of_a.Correct(a.Block(), kFirst);
    of_b.Correct(b.Block(), kFirst);
    const auto half = [&](std::uint32_t i) { return i / groups.unit % 2; };
    int differ = 0;
    for (std::uint32_t p = 0; p < 16; ++p) {
      for (std::uint32_t i = 0; i < kCount; ++i) {
        const bool same = a.At(0, p, i) == b.At(0, p, i);
        if (p == 5 && i == kChanged) continue;
        // Before the next fit, and in the same half, replicate or unit ever after.
        if (i < 32 || half(i) == half(kChanged)) REQUIRE(same);
        differ += !same;
        if (i < 8) REQUIRE(a.At(0, p, i) == original.At(0, p, i));
      }
    }
    CHECK(differ > 50);
  }
}

TEST_CASE("regression: how samples are cut into tasks does not matter", "[control]") {
  for (const SampleGroups& groups : kAllGroups) {
    Buffer whole = Simulate(4, 150, groups, 6), source = whole;
    RegressionFilm of_whole(0, 0, 4, 4, groups, 0.7), of_parts(0, 0, 4, 4, groups, 0.7);
    of_whole.Correct(whole.Block(), kFirst);
    std::uint32_t first = 0;
    for (std::uint32_t count : {1u, 2u, 5u, 29u, 1u, 13u, 64u, 35u}) {
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
    REQUIRE(first == 150);
  }
}

namespace {

// A window of the image, whose samples are made up of the pixel and their number only,
// corrected in tiles.
class TiledImage {
 public:
  static constexpr int kX0 = 5, kY0 = 9, kX1 = 75, kY1 = 60, kWidth = 90;

  TiledImage() : film_(kX0, kY0, kX1 - kX0, kY1 - kY0, {1, true}, 1) {}

  // The sum of the corrected samples of each pixel of the image.
  std::vector<double> Correct(int side, std::uint32_t count) {
    std::vector<double> sums(std::size_t{kWidth} * kY1);
    for (int y = kY0 / side * side; y < kY1; y += side) {
      for (int x = kX0 / side * side; x < kX1; x += side) {
        CorrectTile({std::max(x, kX0), std::max(y, kY0), std::min(x + side, kX1),
                     std::min(y + side, kY1), nullptr, 0, kWidth, nullptr, count},
                    sums);
      }
    }
    return sums;
  }

 private:
  void CorrectTile(SampleBlock block, std::vector<double>& sums) {
    std::vector<std::uint32_t> pixels;
    for (int y = block.y0; y < block.y1; ++y) {
      for (int x = block.x0; x < block.x1; ++x) {
        pixels.push_back(static_cast<std::uint32_t>(y * kWidth + x));
      }
    }
    std::vector<float> values(pixels.size() * kPlanes * block.count);
    block.pixels = pixels.data();
    block.num_pixels = static_cast<std::uint32_t>(pixels.size());
    block.values = values.data();
    for (std::uint32_t p = 0; p < block.num_pixels; ++p) {
      std::mt19937 engine(pixels[p]);
      for (std::uint32_t i = 0; i < block.count; ++i) {
        float u[RegressionFilm::kPlanes];
        for (int k = 0; k < RegressionFilm::kPlanes; ++k) {
          u[k] = float(engine() >> 8) * 0x1p-24f;
          block.At(kFirst + k, p)[i] = u[k];
        }
        for (int c = 0; c < 3; ++c) block.At(c, p)[i] = Value(u);
      }
    }
    film_.Correct(block, kFirst);
    for (std::uint32_t p = 0; p < block.num_pixels; ++p) {
      for (std::uint32_t i = 0; i < block.count; ++i) {
        sums[pixels[p]] += double(block.At(2, p)[i]);
      }
    }
  }

  RegressionFilm film_;
};

}  // namespace

TEST_CASE("regression: how the image is cut into tiles does not matter", "[control]") {
  const std::vector<double> reference = TiledImage().Correct(16, 40);
  CHECK(TiledImage().Correct(32, 40) == reference);
  CHECK(TiledImage().Correct(64, 40) == reference);
  // Blocks that are no whole ones are, so the check can fail.
  CHECK(TiledImage().Correct(8, 40) != reference);
}

TEST_CASE("regression: a million samples are learned from, and no more", "[control]") {
  constexpr std::uint32_t kAtOnce = 4096;
  RegressionFilm film(0, 0, 1, 1, {1, false}, 1);
  const auto fits = [&] {
    const StateColumn column = film.Columns().back();
    std::vector<char> bytes(column.RowBytes());
    std::memcpy(bytes.data(), column.data, bytes.size());
    return bytes;
  };
  double squares = 0;
  std::vector<char> last;
  const std::uint64_t calls = RegressionFilm::kMostFitted / kAtOnce;
  for (std::uint64_t call = 0; call < calls + 2; ++call) {
    if (call == calls + 1) last = fits();
    Buffer own = Simulate(1, kAtOnce, {1, false}, static_cast<unsigned>(call));
    film.Correct(own.Block(), kFirst);
    if (call < calls) continue;
    for (std::uint32_t i = 0; i < kAtOnce; ++i) {
      const double d = double(own.At(0, 0, i)) - kMean;
      squares += d * d / (2 * kAtOnce);
    }
  }
  CHECK(last == fits());
  CHECK(squares == Approx(4.0 / 144).epsilon(0.1));
}

}  // namespace lanelight
