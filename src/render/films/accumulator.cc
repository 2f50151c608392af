#include "src/render/films/accumulator.h"

#include <algorithm>

#include "src/base/core/aligned.h"
#include "src/base/core/check.h"
#include "src/render/films/regression_film.h"

namespace lanelight {

FilmAccumulator::FilmAccumulator(int x0, int y0, int width, int height,
                                 const SampleGroups& groups, Auxiliary auxiliary)
    : x0_(x0), y0_(y0), width_(width), height_(height), groups_(groups) {
  LL_CHECK_GT(width, 0);
  LL_CHECK_GT(height, 0);
  LL_CHECK(groups.unit == 1 || groups.unit == 2);
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  ResizeInHugePages(samples_, pixels);
  if (groups.replicates) {
    ResizeInHugePages(replicates_, pixels);
  } else {
    ResizeInHugePages(units_, pixels);
    if (groups.unit > 1) open_.resize(pixels);
  }
  if (auxiliary >= Auxiliary::kAov) ResizeInHugePages(aov_, pixels);
  if (auxiliary >= Auxiliary::kGbuffer) ResizeInHugePages(gbuffer_, pixels);
  features_ = AuxiliaryFeatures(auxiliary);
  planes_ = SamplePlanes(features_);
}

std::size_t FilmAccumulator::BytesPerPixel(const SampleGroups& groups,
                                           Auxiliary auxiliary) {
  std::size_t bytes = sizeof(std::uint64_t);
  bytes += groups.replicates ? sizeof(ReplicateSums) : sizeof(UnitSums);
  if (!groups.replicates && groups.unit > 1) bytes += sizeof(Open);
  if (auxiliary >= Auxiliary::kAov) bytes += sizeof(AovSums);
  if (auxiliary >= Auxiliary::kGbuffer) bytes += sizeof(GbufferSums);
  return bytes;
}

void FilmAccumulator::UseRegression(double coefficient) {
  for (std::uint64_t samples : samples_) LL_CHECK_EQ(samples, std::uint64_t{0});
  control_ = std::make_unique<RegressionFilm>(
      PixelRect{x0_, y0_, x0_ + width_, y0_ + height_}, groups_, coefficient);
  features_.Add(Feature::kRegressionControl);
  planes_ = SamplePlanes(features_);
}

void FilmAccumulator::UseBuckets(const SpectralBuckets& buckets) {
  for (std::uint64_t samples : samples_) LL_CHECK_EQ(samples, std::uint64_t{0});
  bucket_film_ = std::make_unique<BucketFilm>(buckets, samples_.size());
  features_.Add(Feature::kSpectralFilm);
  planes_ = SamplePlanes(features_);
}

void FilmAccumulator::UseSplats(double unit) {
  splat_film_ = std::make_unique<SplatFilm>(samples_.size(), unit);
}

void FilmAccumulator::FitControl() {
  if (control_) control_->Fit({samples_, replicates_});
}

std::optional<ControlReport> FilmAccumulator::Control() const {
  if (!control_) return std::nullopt;
  return control_->Report({samples_, replicates_});
}

void FilmAccumulator::AddSamples(int x, int y, const float* const* planes,
                                 std::uint32_t count) {
  const std::size_t index = Index(x, y);
  AddColors(index, planes, count);
  if (control_) {
    control_->Add(index, {samples_[index], count, planes,
                          planes + planes_.First(PlaneGroup::kNumbers)});
  }
  if (has_aov()) AddPlanes(PlaneGroup::kAov, planes, count, aov_[index].of);
  if (has_gbuffer()) AddPlanes(PlaneGroup::kGbuffer, planes, count, gbuffer_[index].of);
  if (bucket_film_) {
    bucket_film_->Add(index, planes + planes_.First(PlaneGroup::kRadiance),
                      planes[planes_.First(PlaneGroup::kTriple)], count);
  }
  samples_[index] += count;
}

void FilmAccumulator::AddColors(std::size_t index, const float* const* planes,
                                std::uint32_t count) {
  const std::uint64_t first = samples_[index];
  if (groups_.replicates) {
    ReplicateSums sums = replicates_[index];
    for (std::uint32_t i = 0; i < count; ++i) {
      double* const sum = sums.of[groups_.Replicate(first + i)];
      for (int c = 0; c < kColorPlanes; ++c) sum[c] += double(planes[c][i]);
    }
    replicates_[index] = sums;
    return;
  }
  UnitSums sums = units_[index];
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool closes = (first + i + 1) % groups_.unit == 0;
    for (int c = 0; c < kColorPlanes; ++c) {
      const double value = double(planes[c][i]);
      sums.sum[c] += value;
      double mean = value;
      if (groups_.unit > 1) {
        double& open = open_[index].sum[c];
        open += value;
        mean = open / groups_.unit;
        if (closes) open = 0;
      }
      if (closes) sums.squares[c] += mean * mean;
    }
  }
  units_[index] = sums;
}

void FilmAccumulator::AddPlanes(PlaneGroup group, const float* const* planes,
                                std::uint32_t count, std::span<double> sums) {
  const float* const* const first = planes + planes_.First(group);
  for (std::size_t p = 0; p < sums.size(); ++p) {
    for (std::uint32_t i = 0; i < count; ++i) sums[p] += double(first[p][i]);
  }
}

Rgb FilmAccumulator::Sum(std::size_t index) const {
  Rgb sum;
  for (int c = 0; c < 3; ++c) {
    sum[c] = groups_.replicates ? replicates_[index].Total(c) : units_[index].sum[c];
  }
  return sum;
}

Rgb FilmAccumulator::Mean(int x, int y) const {
  const std::size_t index = Index(x, y);
  const std::uint64_t samples = samples_[index];
  if (samples == 0) return {};
  Rgb sum = Sum(index);
  if (control_) sum = sum - control_->Correction(index, samples);
  const Rgb mean = sum / double(samples);
  return splat_film_ ? mean + splat_film_->Mean(index) : mean;
}

Rgb FilmAccumulator::Variance(int x, int y) const {
  if (!HasVariance(x, y)) return {};
  const std::size_t index = Index(x, y);
  const Rgb variance =
      groups_.replicates ? ReplicateVariance(index) : UnitVariance(index);
  return splat_film_ ? variance + splat_film_->Variance(index) : variance;
}

Rgb FilmAccumulator::ReplicateVariance(std::size_t index) const {
  ReplicateSums sums = replicates_[index];
  if (control_) control_->CorrectReplicates(index, sums);
  Rgb variance;
  for (int c = 0; c < 3; ++c) {
    variance[c] = sums.VarianceOfMean(c, samples_[index], groups_);
  }
  return variance;
}

// Sample variance of the units' means, over their number for the variance of their mean,
// and scaled down by the share of a sample that has no partner yet.
Rgb FilmAccumulator::UnitVariance(std::size_t index) const {
  const double n = double(groups_.Observations(samples_[index]));
  const double fraction = n * groups_.unit / double(samples_[index]);
  if (control_) {
    return control_->ResidualSquares(index, samples_[index]) * (fraction / (n * (n - 1)));
  }
  Rgb variance;
  for (int c = 0; c < 3; ++c) {
    const double open = groups_.unit > 1 ? open_[index].sum[c] : 0;
    const double mean = (units_[index].sum[c] - open) / groups_.unit / n;
    const double scatter = std::max(0.0, units_[index].squares[c] / n - mean * mean);
    variance[c] = scatter / (n - 1) * fraction;
  }
  return variance;
}

double FilmAccumulator::Aov(int x, int y, int plane) const {
  LL_CHECK(has_aov());
  const std::size_t index = Index(x, y);
  if (samples_[index] == 0) return 0;
  return aov_[index].of[plane] / double(samples_[index]);
}

double FilmAccumulator::Gbuffer(int x, int y, int plane) const {
  const std::size_t index = Index(x, y);
  const double hits = gbuffer_[index].of[0];
  if (hits == 0) return 0;
  return plane == 0 ? hits / double(samples_[index]) : gbuffer_[index].of[plane] / hits;
}

double FilmAccumulator::Bucket(int x, int y, int bucket) const {
  LL_CHECK(bucket_film_ != nullptr);
  const std::size_t index = Index(x, y);
  if (samples_[index] == 0) return 0;
  return bucket_film_->Sum(index, bucket) / double(samples_[index]);
}

std::vector<MutableStateColumn> FilmAccumulator::Columns() {
  std::vector<MutableStateColumn> columns = {
      MakeStateColumn<std::uint64_t>("samples", "samples taken", samples_, {})};
  if (groups_.replicates) {
    columns.push_back(MakeStateColumn<double>(
        "replicates", "sums of the samples, by replicate and channel", replicates_,
        {kReplicates, 3}));
  } else {
    columns.push_back(MakeStateColumn<double>(
        "units", "sums of the samples, then of the squares of units' means, by channel",
        units_, {2, 3}));
  }
  if (!open_.empty()) {
    columns.push_back(MakeStateColumn<double>(
        "open", "sum of a pair's first sample, by channel", open_, {3}));
  }
  if (has_aov()) {
    columns.push_back(MakeStateColumn<double>(
        "aov", "sums of albedo R, G, B, normal X, Y, Z and depth", aov_, {kAovPlanes}));
  }
  if (has_gbuffer()) {
    columns.push_back(MakeStateColumn<double>(
        "gbuffer",
        "samples that hit something, and sums over them: point, geometric normal, "
        "shading normal (X, Y, Z each), u, v, dz/dx, dz/dy",
        gbuffer_, {kGbufferPlanes}));
  }
  if (bucket_film_) columns.push_back(bucket_film_->Column());
  if (!control_) return columns;
  for (MutableStateColumn& column : control_->Columns())
    columns.push_back(std::move(column));
  return columns;
}

std::vector<MutableStateColumn> FilmAccumulator::SharedColumns() {
  return splat_film_ ? splat_film_->Columns() : std::vector<MutableStateColumn>();
}

void FilmAccumulator::AddShared(FilmAccumulator& other) {
  const auto columns = SharedColumns(), others = other.SharedColumns();
  LL_CHECK_EQ(columns.size(), others.size());
  for (std::size_t i = 0; i < columns.size(); ++i) AddColumn(columns[i], others[i]);
}

}  // namespace lanelight
