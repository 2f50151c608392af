// Samples of a known function, as the engine's tasks bring them to control=regression.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "src/render/films/accumulator.h"
#include "src/render/films/regression_film.h"

namespace lanelight::regression_samples {

inline constexpr int kFirst = 3;  // plane of the codes, after the colours
inline constexpr int kPlanes = kFirst + RegressionFilm::kPlanes;
// Of a sample: two each for position, direction and light point, and a choice.
inline constexpr int kNumbers = 7;
inline constexpr float kP = 0.3f;
inline constexpr double kMean = 1.65;

// Of a direction's first number u, a light point's first number v, the direction's second
// w and a choice: mean 7/6 + 1/3 + 0.15, skewed, and no polynomial in the basis (the
// product u v is not, nor what is quadratic in v). Of its variance 4/144 is that of
// 2 (u - 1/2) (v - 1/2) and 1/180 that of v^2 about its line: both stay.
inline float Value(const float* numbers) {
  const float u = numbers[2], v = numbers[4], w = numbers[3];
  return (u + v) * (u + v) + w * w + (numbers[6] < kP ? 0.5f : 0.0f);
}
inline constexpr double kLeft = 4.0 / 144 + 1.0 / 180;
// All of it: of (u + v)^2, of w^2 and of the choice.
inline constexpr double kPlain = 31.0 / 15 - 49.0 / 36 + 4.0 / 45 + 0.21 / 4;

// The planes of such a sample.
inline void Encode(const float* numbers, float* planes) {
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
    const std::uint32_t max_samples =
        groups.replicates ? static_cast<std::uint32_t>(groups.InReplicate(count_, 0))
                          : groups.unit;
    std::vector<std::uint32_t> order(max_samples);
    std::uint32_t used = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (groups.Replicate(i) != replicate) continue;
      if (used % max_samples == 0) {
        std::iota(order.begin(), order.end(), 0u);
        std::shuffle(order.begin(), order.end(), engine_);
      }
      const float stratum = float(order[used++ % max_samples]);
      const float u = std::uniform_real_distribution<float>(0, 1)(engine_);
      numbers_[kNumbers * std::size_t{i} + static_cast<std::size_t>(number)] =
          std::min(0x1.fffffep-1f, (stratum + u) / float(max_samples));
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
inline double WronglyFitted(Samples& s, int pixel) {
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

inline double ZScore(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (double v : values) sum += v, squares += v * v;
  const double n = double(values.size()), mean = sum / n;
  return (mean - kMean) / std::sqrt((squares / n - mean * mean) / (n - 1));
}

constexpr SampleGroups kAllGroups[] = {{1, false}, {1, true}, {2, true}};

}  // namespace lanelight::regression_samples
