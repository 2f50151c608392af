#include "src/render/films/splat_film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace lanelight {
namespace {

constexpr double kHigh[SplatSums::kValues] = {0x1p24, 0x1p24, 0x1p24,
                                              0x1p16, 0x1p16, 0x1p16};
constexpr double kLow = 0x1p40;  // times kHigh
// Added to a number below 2^51, it leaves the nearest integer in the lowest bits.
constexpr double kRound = 0x1.8p52;

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
    const std::int64_t carry = (low[i] + (std::int64_t{1} << 39)) >> 40;
    high[i] += carry;
    low[i] -= carry << 40;
  }
}

double SplatSums::Value(int i) const {
  return (static_cast<double>(high[i]) + static_cast<double>(low[i]) / kLow) / kHigh[i];
}

void SplatFilm::Add(const std::vector<PixelSplat>& splats,
                    const std::vector<std::size_t>& pixels,
                    std::uint64_t paths_per_pixel) {
  const std::lock_guard lock(mutex_);
  for (const PixelSplat& splat : splats) sums_[splat.pixel].Add(splat.light);
  for (const std::size_t pixel : pixels) paths_[pixel] += paths_per_pixel;
  total_ = counted_ ? total_ + paths_per_pixel * pixels.size() : 0;
}

std::uint64_t SplatFilm::Paths() const {
  if (!counted_ || total_ == 0) {
    total_ = std::accumulate(paths_.begin(), paths_.end(), std::uint64_t{0});
    counted_ = true;
  }
  return total_;
}

Rgb SplatFilm::Mean(std::size_t pixel) const {
  const std::lock_guard lock(mutex_);
  const auto paths = double(Paths());
  Rgb mean;
  if (paths == 0) return mean;
  const double scale = unit_ * double(sums_.size()) / paths;
  for (int c = 0; c < 3; ++c) mean[c] = sums_[pixel].Value(c) * scale;
  return mean;
}

Rgb SplatFilm::Variance(std::size_t pixel) const {
  const std::lock_guard lock(mutex_);
  const auto n = double(Paths());
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
  counted_ = false;  // the caller may fill them
  return {MakeStateColumn<std::uint64_t>(
              "splats",
              "sums of what light subpaths bring, then of its squares, by channel, in "
              "splat_unit: integers times 2^-24 and 2^-16, then times 2^-64 and 2^-56; "
              "two's complement",
              sums_, {2, 2, 3}),
          MakeStateColumn<std::uint64_t>("light_paths", "light subpaths started", paths_,
                                         {})};
}

}  // namespace lanelight
