// control=regression: the fit removes the share of f that is quadratic in the numbers of
// a path's first choices. Each half of the samples is corrected by the other, so that the
// mean stays, however samples of one replicate depend on each other.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "src/image/accumulator.h"
#include "src/image/regression_film.h"

namespace lanelight {
namespace {

constexpr int kFirst = 3;  // plane of the codes, after the colours
constexpr int kPlanes = kFirst + RegressionFilm::kPlanes;
// Of a sample: two each for position, direction and light point, and a choice.
constexpr int kNumbers = 7;
constexpr float kP = 0.3f;
constexpr double kMean = 1.65;

// Of a direction's first number u, a light point's first number v, the direction's second
// w and a choice: mean 7/6 + 1/3 + 0.15, skewed, and no polynomial in the basis (the
// product u v is not, nor what is quadratic in v). Of its variance 4/144 is that of
// 2 (u - 1/2) (v - 1/2) and 1/180 that of v^2 about its line: both stay.
float Value(const float* numbers) {
  const float u = numbers[2], v = numbers[4], w = numbers[3];
  return (u + v) * (u + v) + w * w + (numbers[6] < kP ? 0.5f : 0.0f);
}
constexpr double kLeft = 4.0 / 144 + 1.0 / 180;
// All of it: of (u + v)^2, of w^2 and of the choice.
constexpr double kPlain = 31.0 / 15 - 49.0 / 36 + 4.0 / 45 + 0.21 / 4;

// The planes of such a sample.
void Encode(const float* numbers, float* planes) {
  for (int k = 0; k < 3; ++k) {
    planes[k] = std::bit_cast<float>(PairCode(numbers[2 * k], numbers[2 * k + 1]));
  }
  planes[3] = std::bit_cast<float>(ChoiceCode(numbers[6], kP));  // no second choice
}

// Samples of the pixels of a square, as the engine's tasks have them. Those of a
// replicate, or else of a unit, depend on each other: each number has one of them in each
// stratum, in random order.
class Samples {
 public:
  Samples(int side, std::uint32_t count, const SampleGroups& groups, unsigned seed)
      : side_(side), count_(count), engine_(seed) {
    values_.resize(static_cast<std::size_t>(side * side * kPlanes) * count);
    numbers_.resize(kNumbers * std::size_t{count});
    for (int p = 0; p < side * side; ++p) {
      for (std::uint32_t r = 0; r < kReplicates; ++r) {
        for (int k = 0; k < kNumbers; ++k) Draw(k, groups, r);
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        float codes[RegressionFilm::kPlanes];
        Encode(&numbers_[kNumbers * i], codes);
        for (int k = 0; k < RegressionFilm::kPlanes; ++k) At(kFirst + k, p, i) = codes[k];
        for (int c = 0; c < 3; ++c) At(c, p, i) = Value(&numbers_[kNumbers * i]);
      }
    }
  }
  int pixels() const { return side_ * side_; }
  std::uint32_t count() const { return count_; }
  float& At(int plane, int pixel, std::uint32_t sample) {
    return values_[static_cast<std::size_t>(pixel * kPlanes + plane) * count_ + sample];
  }
  // To a film, in runs of `at_once` samples.
  template <class Film>
  void AddTo(Film& film, std::uint32_t at_once = 1u << 30) {
    for (int p = 0; p < pixels(); ++p) {
      for (std::uint32_t begin = 0; begin < count_; begin += at_once) {
        const float* planes[kPlanes];
        for (int k = 0; k < kPlanes; ++k) planes[k] = &At(k, p, begin);
        const std::uint32_t n = std::min(at_once, count_ - begin);
        if constexpr (std::is_same_v<Film, RegressionFilm>) {
          film.Add(static_cast<std::size_t>(p), {begin, n, planes, planes + kFirst});
        } else {
          film.AddSamples(p % side_, p / side_, planes, n);
        }
      }
    }
  }
  double Mean(int pixel) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count_; ++i) sum += double(At(0, pixel, i));
    return sum / count_;
  }

 private:
  void Draw(int number, const SampleGroups& groups, std::uint32_t replicate) {
    const std::uint32_t most =
        groups.replicates ? static_cast<std::uint32_t>(groups.InReplicate(count_, 0))
                          : groups.unit;
    std::vector<std::uint32_t> order(most);
    std::uint32_t taken = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (groups.Replicate(i) != replicate) continue;
      if (taken % most == 0) {
        std::iota(order.begin(), order.end(), 0u);
        std::shuffle(order.begin(), order.end(), engine_);
      }
      const float stratum = float(order[taken++ % most]);
      const float u = std::uniform_real_distribution<float>(0, 1)(engine_);
      numbers_[kNumbers * std::size_t{i} + static_cast<std::size_t>(number)] =
          std::min(0x1.fffffep-1f, (stratum + u) / float(most));
    }
  }

  int side_;
  std::uint32_t count_;
  std::mt19937 engine_;
  std::vector<float> values_, numbers_;
};

FilmAccumulator FilmOf(Samples& samples, int side, const SampleGroups& groups,
                       double coefficient = 1) {
  FilmAccumulator film(0, 0, side, side, groups, Auxiliary::kNone);
  film.UseRegression(coefficient);
  samples.AddTo(film);
  film.FitControl();
  return film;
}

// The mean of a pixel, with a fit to the very samples: what must not be done.
double WronglyFitted(Samples& s, int pixel) {
  const double n = s.count(), mean = s.Mean(pixel);
  double products[RegressionFilm::kFunctions] = {}, sums[RegressionFilm::kFunctions] = {};
  for (std::uint32_t i = 0; i < s.count(); ++i) {
    float codes[RegressionFilm::kPlanes], phi[RegressionFilm::kFunctions];
    for (int k = 0; k < RegressionFilm::kPlanes; ++k) {
      codes[k] = s.At(kFirst + k, pixel, i);
    }
    RegressionFilm::Functions(codes, phi);
    for (int j = 0; j < RegressionFilm::kFunctions; ++j) {
      products[j] += (double(s.At(0, pixel, i)) - mean) * double(phi[j]) / n;
      sums[j] += double(phi[j]) / n;
    }
  }
  double corrected = mean;
  for (int j = 0; j < RegressionFilm::kFunctions; ++j) corrected -= products[j] * sums[j];
  return corrected;
}

double ZScore(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (double v : values) sum += v, squares += v * v;
  const double n = double(values.size()), mean = sum / n;
  return (mean - kMean) / std::sqrt((squares / n - mean * mean) / (n - 1));
}

constexpr SampleGroups kAllGroups[] = {{1, false}, {1, true}, {2, true}};

}  // namespace

TEST_CASE("regression: the functions are orthonormal with mean 0", "[control]") {
  constexpr int kSteps = 200, kFunctions = RegressionFilm::kFunctions - 2;
  double means[kFunctions] = {}, products[kFunctions][kFunctions] = {};
  for (int a = 0; a < kSteps; ++a) {
    for (int b = 0; b < kSteps; ++b) {
      const float u = (float(a) + 0.5f) / kSteps, v = (float(b) + 0.5f) / kSteps;
      const float numbers[] = {u, v, u, v, u, v, 0};
      float codes[RegressionFilm::kPlanes], phi[RegressionFilm::kFunctions];
      Encode(numbers, codes);
      RegressionFilm::Functions(codes, phi);
      for (int i = 0; i < kFunctions; ++i) {
        means[i] += double(phi[i]) / (kSteps * kSteps);
        for (int j = 0; j < kFunctions; ++j) {
          products[i][j] += double(phi[i] * phi[j]) / (kSteps * kSteps);
        }
      }
    }
  }
  // The same numbers drive position, direction (2 to 3, 6 to 8) and light (4, 5, 9) here.
  constexpr int kKind[kFunctions] = {0, 1, 0, 1, 0, 1, 2, 3, 4, 4};
  for (int i = 0; i < kFunctions; ++i) {
    CHECK(std::abs(means[i]) < 1e-4);
    for (int j = 0; j < kFunctions; ++j) {
      CHECK(products[i][j] == Approx(kKind[i] == kKind[j] ? 1 : 0).margin(1e-3));
    }
  }
}

TEST_CASE("regression: choices have mean 0, and where none is are no functions",
          "[control]") {
  float phi[RegressionFilm::kFunctions];
  for (float p : {0.001f, 0.04f, 0.3f, 0.5f, 0.97f}) {
    constexpr int kSteps = 1 << 16;
    double mean = 0, square = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float u = float(i) / kSteps;
      const float codes[] = {0, 0, 0, std::bit_cast<float>(ChoiceCode(u, p) << 16)};
      RegressionFilm::Functions(codes, phi);
      for (int j = 0; j < 11; ++j) REQUIRE(phi[j] == 0);
      mean += double(phi[11]) / kSteps;
      square += double(phi[11]) * double(phi[11]) / kSteps;
    }
    CHECK(std::abs(mean) < 1e-6);
    CHECK(square == Approx(9 * double(p) * (1 - double(p))).epsilon(0.05));
  }
}

TEST_CASE("regression: unbiased where a fit to the same samples is not", "[control]") {
  constexpr int kSide = 16;
  for (const SampleGroups& groups : kAllGroups) {
    std::vector<double> corrected, plain, self, biased;
    for (unsigned seed = 0; seed < 150; ++seed) {
      Samples s(kSide, 24, groups, 400 * groups.unit + 200 * groups.replicates + seed);
      const FilmAccumulator film = FilmOf(s, kSide, groups);
      for (int p = 0; p < s.pixels(); ++p) {
        corrected.push_back(film.Mean(p % kSide, p / kSide).x);
        plain.push_back(film.PlainMean(p % kSide, p / kSide).x);
        CHECK(plain.back() == Approx(s.Mean(p)));
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

TEST_CASE("regression: what the fit explains goes away, and c = 1 is best", "[control]") {
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

TEST_CASE("regression: samples never see their own half", "[control]") {
  constexpr std::uint32_t kChanged = 30;
  for (const SampleGroups& groups : kAllGroups) {
    Samples a(4, 60, groups, 4), b = a;
    for (int c = 0; c < 3; ++c) b.At(c, 5, kChanged) += 100;
    const std::vector<std::uint64_t> counts(16, 60);
    const ControlledColors colors = {counts, {}};
    RegressionFilm of_a({0, 0, 4, 4}, groups, 1), of_b({0, 0, 4, 4}, groups, 1);
    a.AddTo(of_a), b.AddTo(of_b);
    of_a.Fit(colors), of_b.Fit(colors);
    const std::uint32_t turns = groups.replicates ? kReplicates : 2;
    int differ = 0;
    for (std::size_t p = 0; p < 16; ++p) {
      ReplicateSums sums_a, sums_b;
      of_a.CorrectReplicates(p, sums_a), of_b.CorrectReplicates(p, sums_b);
      for (std::uint32_t t = 0; t < turns; ++t) {
        const bool same = sums_a.of[t][0] == sums_b.of[t][0];
        CHECK(sums_a.of[t][0] != 0);
        if (t % 2 == kChanged / groups.unit % turns % 2) CHECK(same);
        differ += !same;
      }
    }
    CHECK(differ > 8);
  }
}

TEST_CASE("regression: how samples come in does not matter", "[control]") {
  for (const SampleGroups& groups : kAllGroups) {
    Samples s(4, 150, groups, 6);
    RegressionFilm whole({0, 0, 4, 4}, groups, 1), parts({0, 0, 4, 4}, groups, 1);
    s.AddTo(whole), s.AddTo(parts, 7);
    const std::vector<MutableStateColumn> a = whole.Columns(), b = parts.Columns();
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(std::memcmp(a[i].data, b[i].data, a[i].Bytes()) == 0);
    }
  }
}

TEST_CASE("regression: a crop of whole blocks is as in the image", "[control]") {
  constexpr int kSide = 12, kFrom = RegressionFilm::kBlock;
  const SampleGroups groups = {1, false};
  Samples s(kSide, 16, groups, 8);
  const FilmAccumulator film = FilmOf(s, kSide, groups);
  const auto crop = [&](int from) {
    FilmAccumulator part(from, from, kSide - from, kSide - from, groups,
                         Auxiliary::kNone);
    part.UseRegression(1);
    for (int y = from; y < kSide; ++y) {
      for (int x = from; x < kSide; ++x) {
        const float* planes[kPlanes];
        for (int k = 0; k < kPlanes; ++k) planes[k] = &s.At(k, y * kSide + x, 0);
        part.AddSamples(x, y, planes, s.count());
      }
    }
    part.FitControl();
    return part;
  };
  const FilmAccumulator whole = crop(kFrom), cut = crop(kFrom + 1);
  for (int y = kFrom; y < kSide; ++y) {
    for (int x = kFrom; x < kSide; ++x) REQUIRE(whole.Mean(x, y) == film.Mean(x, y));
  }
  CHECK(cut.Mean(kFrom + 1, kFrom + 1) != film.Mean(kFrom + 1, kFrom + 1));
}

TEST_CASE("regression: a million samples are learned from, and no more", "[control]") {
  constexpr std::uint32_t kAtOnce = 4096;
  const SampleGroups groups = {1, false};
  RegressionFilm film({0, 0, 1, 1}, groups, 1);
  const auto products = [&] {
    const StateColumn column = film.Columns().back();
    std::vector<char> bytes(column.RowBytes());
    std::memcpy(bytes.data(), column.data, bytes.size());
    return bytes;
  };
  std::vector<char> last;
  const std::uint64_t calls = RegressionFilm::kMostFitted / kAtOnce;
  for (std::uint64_t call = 0; call < calls + 64; ++call) {
    if (call == calls) last = products();
    Samples s(1, kAtOnce, groups, static_cast<unsigned>(call));
    const float* planes[kPlanes];
    for (int k = 0; k < kPlanes; ++k) planes[k] = &s.At(k, 0, 0);
    film.Add(0, {call * kAtOnce, kAtOnce, planes, planes + kFirst});
  }
  CHECK(last == products());
  const std::vector<std::uint64_t> counts = {(calls + 64) * kAtOnce};
  film.Fit({counts, {}});
  const double n = double(counts[0]);
  CHECK(film.ResidualSquares(0, counts[0]).x / n == Approx(kLeft).epsilon(0.05));
}

}  // namespace lanelight
