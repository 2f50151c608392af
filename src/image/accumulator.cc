#include "src/image/accumulator.h"

#include <algorithm>
#include <array>

#include "src/core/check.h"

namespace lanelight {

double GroupScatter::Variance(int channel) const {
  const double n = static_cast<double>(groups), mean = total[channel] / n;
  return std::max(0.0, squares[channel] / n - mean * mean) * n / (n - 1);
}

FilmAccumulator::FilmAccumulator(int x0, int y0, int width, int height,
                                 std::uint32_t group_size, bool aov)
    : x0_(x0), y0_(y0), width_(width), height_(height), group_size_(group_size) {
  LL_CHECK_GT(width, 0);
  LL_CHECK_GT(height, 0);
  LL_CHECK_GT(group_size, 0u);
  const std::size_t pixels =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  pixels_.resize(pixels);
  if (!aov) return;
  aov_.resize(pixels * kAovPlanes);
  planes_ = SamplePlanes({Feature::kAov});
}

void FilmAccumulator::UseControl() {
  for (const Pixel& p : pixels_) LL_CHECK_EQ(p.samples, std::uint64_t{0});
  control_.emplace(width_, height_);
  FeatureSet features = {Feature::kControlDifference};
  if (has_aov()) features.Add(Feature::kAov);
  planes_ = SamplePlanes(features);
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
    p.scatter = {};
    for (int c = 0; c < kColorPlanes; ++c) p.scatter.open[c] = p.sum[c];
  }
  if (control_) control_->Regroup(group_size_);
  group_size_ = group_size;
}

void FilmAccumulator::AddSamples(int x, int y, const float* const* planes,
                                 std::uint32_t count) {
  const std::size_t index = Index(x, y);
  control_ ? AddColors<true>(index, planes, count)
           : AddColors<false>(index, planes, count);
  const int first_aov = planes_.First(PlaneGroup::kAov);
  for (int a = 0; a < kAovPlanes && !aov_.empty(); ++a) {
    for (std::uint32_t i = 0; i < count; ++i) {
      aov_[index * kAovPlanes + a] += planes[first_aov + a][i];
    }
  }
}

template <bool kControl>
void FilmAccumulator::AddColors(std::size_t index, const float* const* planes,
                                std::uint32_t count) {
  [[maybe_unused]] const int first_difference = planes_.First(PlaneGroup::kDifference);
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
      p.scatter.open[c] += value;
      if constexpr (kControl) {
        control_->AddDifference(index, c, planes[first_difference + c][i]);
      }
      if (!closes_group) continue;
      means[c] = p.scatter.Close(c, group_size_);
    }
    if (!closes_group) continue;
    in_group = 0;
    ++p.scatter.groups;
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
      p.scatter.AddMean(c, value);
    }
  }
  p.samples += count;
  p.scatter.groups += count;
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
  if (p.scatter.groups < 2) return {};
  const double n = static_cast<double>(p.scatter.groups);
  // Sample variance of the group means, over n for the variance of their mean, and scaled
  // down by the share of samples that incomplete groups add.
  const double share = n * group_size_ / static_cast<double>(p.samples);
  if (control_) return control_->ResidualSquares(Index(x, y)) * (share / (n * (n - 1)));
  Rgb variance;
  for (int c = 0; c < 3; ++c) variance[c] = p.scatter.Variance(c) / n * share;
  return variance;
}

Rgb FilmAccumulator::OpenGroupExcess(int x, int y) const {
  const Pixel& p = pixel(x, y);
  const double open = static_cast<double>(p.samples % group_size_);
  if (open == 0 || p.scatter.groups < 2) return {};
  const double rest = open / static_cast<double>(p.samples), share = 1 - rest;
  Rgb sum = {p.scatter.open[0], p.scatter.open[1], p.scatter.open[2]};
  if (control_) sum = sum - control_->OpenCorrection(Index(x, y));
  const Rgb distance = (sum / open - Mean(x, y)) / share;
  const Rgb variance = Variance(x, y);
  Rgb excess;
  for (int c = 0; c < 3; ++c) {
    excess[c] = rest * rest * distance[c] * distance[c] - rest / share * variance[c];
  }
  return excess;
}

void FilmAccumulator::Save(StateWriter& state) const {
  state.Write("film window", std::array{x0_, y0_, width_, height_});
  state.Write("film group size", group_size_);
  state.Write("film pixels", pixels_.data(), pixels_.size());
  state.Write("film auxiliary planes", aov_.data(), aov_.size());
  state.Write("film has a control variate", control_.has_value());
  if (control_) control_->Save(state);
}

void FilmAccumulator::Restore(StateReader& state) {
  state.Expect("film window", std::array{x0_, y0_, width_, height_});
  state.Expect("film group size", group_size_);
  state.Read("film pixels", pixels_.data(), pixels_.size());
  state.Read("film auxiliary planes", aov_.data(), aov_.size());
  state.Expect("film has a control variate", control_.has_value());
  if (control_) control_->Restore(state);
}

double FilmAccumulator::Aov(int x, int y, int plane) const {
  const Pixel& p = pixel(x, y);
  LL_CHECK(has_aov());
  if (p.samples == 0) return 0;
  const std::size_t index = Index(x, y);
  return aov_[index * kAovPlanes + plane] / static_cast<double>(p.samples);
}

}  // namespace lanelight
