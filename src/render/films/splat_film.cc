#include "src/render/films/splat_film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace lanelight {
namespace {

constexpr double kHigh[SplatSums::kValues] = {0x1p24, 0x1p24, 0x1p24,
                                              0x1p16, 0x1p16, 0x1p16};
constexpr double kLow = 0x1p40;  // times kHigh
// Added to a number below 2^51, it leaves the nearest integer in the lowest bits.
constexpr double kRound = 0x1.8p52;

// Returns what of a low part belongs to the high one.
constexpr std::int64_t CarryOf(std::int64_t low) {
  return (low + (std::int64_t{1} << 39)) >> 40;
}

}  // namespace

void SplatSums::Add(const float light[3]) {
  double values[kValues];
  for (int c = 0; c < 3; ++c) {
    values[c] = double(light[c]);
    values[c + 3] = values[c] * values[c];
  }
  constexpr auto kBits = std::bit_cast<std::int64_t>(kRound);
  std::uint64_t large = 0;
  for (int i = 0; i < kValues; ++i) {
    const double scaled = values[i] * kHigh[i];
    const double whole = scaled + kRound;
    const double rest = (scaled - (whole - kRound)) * kLow + kRound;
    high[i] += std::bit_cast<std::int64_t>(whole) - kBits;
    low[i] += std::bit_cast<std::int64_t>(rest) - kBits;
    large |= static_cast<std::uint64_t>(low[i] + (std::int64_t{1} << 62));
  }
  if (large >> 63 != 0) Normalize();
}

void SplatSums::Normalize() {
  for (int i = 0; i < kValues; ++i) {
    const std::int64_t carry = CarryOf(low[i]);
    high[i] += carry;
    low[i] -= carry << 40;
  }
}

double SplatSums::Value(int i) const {
  const std::int64_t carry = CarryOf(low[i]);
  const auto whole = static_cast<double>(high[i] + carry);
  return (whole + static_cast<double>(low[i] - (carry << 40)) / kLow) / kHigh[i];
}

void SplatFilm::Add(const std::vector<PixelSplat>& splats, std::uint64_t paths) {
  const std::lock_guard lock(mutex_);
  for (const PixelSplat& splat : splats) sums_[splat.pixel].Add(splat.light);
  paths_ += paths;
}

Rgb SplatFilm::Mean(std::size_t pixel) const {
  const std::lock_guard lock(mutex_);
  Rgb mean;
  if (paths_ == 0) return mean;
  const double scale = unit_ * double(sums_.size()) / double(paths_);
  for (int c = 0; c < 3; ++c) mean[c] = sums_[pixel].Value(c) * scale;
  return mean;
}

Rgb SplatFilm::Variance(std::size_t pixel) const {
  const std::lock_guard lock(mutex_);
  const auto n = double(paths_);
  Rgb variance;
  if (n < 2) return variance;
  const double scale = unit_ * double(sums_.size());
  for (int c = 0; c < 3; ++c) {
    const double mean = sums_[pixel].Value(c) / n;
    const double scatter = sums_[pixel].Value(3 + c) / n - mean * mean;
    variance[c] = std::max(0.0, scatter) / (n - 1) * scale * scale;
  }
  return variance;
}

std::vector<MutableStateColumn> SplatFilm::Columns() {
  for (SplatSums& sums : sums_) sums.Normalize();
  std::span<std::uint64_t> paths(&paths_, 1);
  return {MakeStateColumn<std::uint64_t>(
              "splats",
              "light of light subpaths: sums by channel for each pixel of the film, then "
              "sums of squares, in splat_unit: integers times 2^-24 and 2^-16, then "
              "times 2^-64 and 2^-56; two's complement",
              sums_, {2, 2, 3}),
          MakeStateColumn<std::uint64_t>("light_paths", "light subpaths started", paths)};
}

}  // namespace lanelight
