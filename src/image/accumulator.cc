#include "src/image/accumulator.h"

#include "src/core/check.h"

namespace lanelight {

FilmAccumulator::FilmAccumulator(int x0, int y0, int width, int height,
                                 std::uint32_t group_size, bool aov)
    : x0_(x0), y0_(y0), width_(width), height_(height), group_size_(group_size) {
  LL_CHECK_GT(width, 0);
  LL_CHECK_GT(height, 0);
  LL_CHECK_GT(group_size, 0u);
  const std::size_t pixels =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  pixels_.resize(pixels);
  if (aov) aov_.resize(pixels * kAovPlanes);
}

void FilmAccumulator::UseControl() {
  for (const Pixel& p : pixels_) LL_CHECK_EQ(p.samples, std::uint64_t{0});
  control_.emplace(width_, height_);
}

void FilmAccumulator::FitControl() {
  if (control_) control_->Fit();
}

std::optional<ControlReport> FilmAccumulator::Control() const {
  if (!control_) return std::nullopt;
  return control_->Report();
}

void FilmAccumulator::Regroup(std::uint32_t group_size) {
  if (group_size == group_size_) return;
  for (Pixel& p : pixels_) {
    LL_CHECK_LT(p.samples, std::uint64_t{group_size});
    p.groups = 0;
    for (int c = 0; c < kColorPlanes; ++c) {
      p.group[c] = p.sum[c];
      p.squares[c] = p.group_total[c] = 0;
    }
  }
  if (control_) control_->Regroup(group_size_);
  group_size_ = group_size;
}

void FilmAccumulator::AddSamples(int x, int y, const float* const* planes,
                                 std::uint32_t count) {
  const std::size_t index = Index(x, y);
  control_ ? AddColors<true>(index, planes, count)
           : AddColors<false>(index, planes, count);
  for (int a = 0; a < kAovPlanes && !aov_.empty(); ++a) {
    for (std::uint32_t i = 0; i < count; ++i) {
      aov_[index * kAovPlanes + a] += planes[kColorPlanes + a][i];
    }
  }
}

template <bool kControl>
void FilmAccumulator::AddColors(std::size_t index, const float* const* planes,
                                std::uint32_t count) {
  [[maybe_unused]] const int first_difference =
      kColorPlanes + (aov_.empty() ? 0 : kAovPlanes);
  Pixel p = pixels_[index];
  if (!kControl && group_size_ == 1) {
    AddGroupsOfOne(planes, count, p);
    pixels_[index] = p;
    return;
  }
  std::uint32_t in_group = static_cast<std::uint32_t>(p.samples % group_size_);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool closes_group = ++in_group == group_size_;
    double means[kColorPlanes];
    for (int c = 0; c < kColorPlanes; ++c) {
      const double value = planes[c][i];
      p.sum[c] += value;
      p.group[c] += value;
      if constexpr (kControl) {
        control_->AddDifference(index, c, planes[first_difference + c][i]);
      }
      if (!closes_group) continue;
      const double mean = p.group[c] / group_size_;
      p.squares[c] += mean * mean;
      p.group_total[c] += mean;
      p.group[c] = 0;
      means[c] = mean;
    }
    if (!closes_group) continue;
    in_group = 0;
    ++p.groups;
    if constexpr (kControl) control_->CloseGroup(index, means, group_size_);
  }
  p.samples += count;
  pixels_[index] = p;
}

// The same sums where every sample is its own mean.
void FilmAccumulator::AddGroupsOfOne(const float* const* planes, std::uint32_t count,
                                     Pixel& p) {
  for (std::uint32_t i = 0; i < count; ++i) {
    for (int c = 0; c < kColorPlanes; ++c) {
      const double value = planes[c][i];
      p.sum[c] += value;
      p.squares[c] += value * value;
      p.group_total[c] += value;
    }
  }
  p.samples += count;
  p.groups += count;
}

Rgb FilmAccumulator::Mean(int x, int y) const {
  const Pixel& p = pixel(x, y);
  if (p.samples == 0) return {};
  Rgb sum = {p.sum[0], p.sum[1], p.sum[2]};
  if (control_) sum = sum - control_->Correction(Index(x, y), group_size_);
  return sum / static_cast<double>(p.samples);
}

Rgb FilmAccumulator::Variance(int x, int y) const {
  const Pixel& p = pixel(x, y);
  if (p.groups < 2) return {};
  const double n = static_cast<double>(p.groups);
  // Sample variance of the group means, over n for the variance of their mean, and scaled
  // down by the share of samples that incomplete groups add.
  const double share = n * group_size_ / static_cast<double>(p.samples);
  if (control_) return control_->ResidualSquares(Index(x, y)) * (share / (n * (n - 1)));
  Rgb variance;
  for (int c = 0; c < 3; ++c) {
    const double mean = p.group_total[c] / n;
    const double scatter = std::max(0.0, p.squares[c] / n - mean * mean) * n / (n - 1);
    variance[c] = scatter / n * share;
  }
  return variance;
}

Rgb FilmAccumulator::OpenGroupExcess(int x, int y) const {
  const Pixel& p = pixel(x, y);
  const double open = static_cast<double>(p.samples % group_size_);
  if (open == 0 || p.groups < 2) return {};
  const double rest = open / static_cast<double>(p.samples), share = 1 - rest;
  Rgb sum = {p.group[0], p.group[1], p.group[2]};
  if (control_) sum = sum - control_->OpenCorrection(Index(x, y));
  const Rgb distance = (sum / open - Mean(x, y)) / share;
  const Rgb variance = Variance(x, y);
  Rgb excess;
  for (int c = 0; c < 3; ++c) {
    excess[c] = rest * rest * distance[c] * distance[c] - rest / share * variance[c];
  }
  return excess;
}

double FilmAccumulator::Aov(int x, int y, int plane) const {
  const Pixel& p = pixel(x, y);
  LL_CHECK(has_aov());
  if (p.samples == 0) return 0;
  const std::size_t index = Index(x, y);
  return aov_[index * kAovPlanes + plane] / static_cast<double>(p.samples);
}

}  // namespace lanelight
