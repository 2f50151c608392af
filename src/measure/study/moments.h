// Sums over the repetitions of a render, pixel by pixel: their mean, and the variance
// between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/core/vec.h"
#include "src/base/stat/hypothesis.h"

namespace lanelight {

class Moments {
 public:
  explicit Moments(std::size_t pixels = 0) : pixels_(pixels) {}

  void Add(const std::vector<Rgb>& image);

  std::size_t size() const { return pixels_.size(); }
  std::uint64_t count() const { return count_; }
  Rgb Mean(std::size_t pixel) const;
  /// Variance of one render; zero for fewer than two.
  Rgb Variance(std::size_t pixel) const;
  /// Of the mean of the three channels.
  double GreyVariance(std::size_t pixel) const;
  /// That mean over the repetitions.
  stat::MeanEstimate GreyEstimate(std::size_t pixel) const;

  /// How many times the variance of a mean of pixels is that of independent ones, at most
  /// their number: above 1 where pixels have paths in common (reuse=block).
  double pixels_as_one = 1;

  /// The sums, to be saved.
  StateColumn Column() const;
  /// The same to be filled with those of `count` images.
  MutableStateColumn Restore(std::uint64_t count);

 private:
  static constexpr int kPlanes = 4;  // red, green, blue, their mean
  struct Pixel {
    std::array<double, kPlanes> sum{}, squares{};
  };
  double PlaneVariance(const Pixel& pixel, int plane) const;

  std::vector<Pixel> pixels_;
  std::uint64_t count_ = 0;
};

}  // namespace lanelight
