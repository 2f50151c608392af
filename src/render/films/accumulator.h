// The film: sums in double, per pixel and channel, of samples by observation. A billion
// samples lose nothing, and dependent samples (one randomisation of a low-discrepancy
// sequence) count as one observation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/films/bucket_film.h"
#include "src/render/films/regression_film.h"
#include "src/render/films/splat_film.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {

class FilmAccumulator {
 public:
  /// A film of the pixels [x0, x0+width) x [y0, y0+height) of the full image, whose
  /// samples count as `groups` says.
  FilmAccumulator(int x0, int y0, int width, int height, const SampleGroups& groups,
                  Auxiliary auxiliary);

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }
  const SampleGroups& groups() const { return groups_; }
  /// Sets SampleGroups::dependents: a trial run may have chosen path reuse.
  void set_dependents(double dependents) { groups_.dependents = dependents; }
  /// Returns the probability of ChanceOfLight (src/scene/prepare/prepared_scene.h).
  double chance_of_light() const { return chance_of_light_; }
  void set_chance_of_light(double chance) { chance_of_light_ = chance; }
  bool has_aov() const { return !aov_.empty(); }
  bool has_gbuffer() const { return !gbuffer_.empty(); }
  static std::size_t BytesPerPixel(const SampleGroups& groups, Auxiliary auxiliary);

  /// Adds the planes of control=regression, whose fit is multiplied by `coefficient`;
  /// before any sample. After FitControl, Mean and Variance are those of the corrected
  /// samples.
  void UseRegression(double coefficient);
  void FitControl();
  /// Adds the planes of wavelengths, of which the film keeps means by bucket; before any
  /// sample.
  void UseBuckets(const SpectralBuckets& buckets);
  /// Adds the sums of light subpaths, in units of `unit`; before any sample.
  void UseSplats(double unit);
  /// Returns null without UseSplats.
  SplatFilm* splats() { return splat_film_.get(); }
  const SplatFilm* splats() const { return splat_film_.get(); }
  /// Returns null without UseBuckets.
  const SpectralBuckets* buckets() const {
    return bucket_film_ ? &bucket_film_->buckets() : nullptr;
  }
  /// Returns the effect of the control variate; empty without UseRegression.
  std::optional<ControlReport> Control() const;

  /// Most planes of a sample.
  static constexpr int kMaxPlanes =
      kColorPlanes + kAovPlanes + kGbufferPlanes + NumPlanes(PlaneGroup::kRadiance) +
      NumPlanes(PlaneGroup::kTriple) + NumPlanes(PlaneGroup::kNumbers);

  /// Adds `count` consecutive samples of one pixel; planes[p][i] is plane p (in the order
  /// of SamplePlanes) of the i-th. Must be called with the samples of a pixel in order.
  /// Safe for different pixels from different threads.
  void AddSamples(int x, int y, const float* const* planes, std::uint32_t count);

  std::uint64_t Samples(int x, int y) const { return samples_[Index(x, y)]; }
  /// Mean of all samples; zero without samples.
  Rgb Mean(int x, int y) const;
  /// Estimated variance of Mean() per channel, from the scatter of observations;
  /// NaN-free: zero where there are fewer than two (see HasVariance).
  Rgb Variance(int x, int y) const;
  bool HasVariance(int x, int y) const { return Observations(x, y) >= 2; }
  /// Independent observations of a pixel.
  std::uint64_t Observations(int x, int y) const {
    return groups_.Observations(Samples(x, y));
  }
  /// Mean of an auxiliary plane.
  double Aov(int x, int y, int plane) const;
  /// Returns the mean of a plane of the g-buffer: of the first, the share of samples that
  /// hit something; of the others, the mean over these. Zero without samples.
  double Gbuffer(int x, int y, int plane) const;
  /// Returns the mean radiance in a bucket at the wavelengths that paths carry, in units
  /// of WhiteRadiance() before exposure. Zero without samples or such wavelengths.
  double Bucket(int x, int y, int bucket) const;

  /// Returns all sums by pixel, row by row; a film of the same pixels, planes and groups
  /// that loads them and SharedColumns() resumes from there.
  std::vector<MutableStateColumn> Columns();
  /// Returns the sums of light subpaths, which reach pixels outside their tile: those of
  /// parts and ranks add up. Empty without UseSplats.
  std::vector<MutableStateColumn> SharedColumns();
  /// Adds those of another film of the same pixels.
  void AddShared(FilmAccumulator& other);

 private:
  // Sums of a pixel whose observations are single units.
  struct UnitSums {
    double sum[3] = {};
    double squares[3] = {};  // of the units' means
  };
  struct Open {
    double sum[3] = {};
  };
  struct AovSums {
    double of[kAovPlanes] = {};
  };
  struct GbufferSums {
    double of[kGbufferPlanes] = {};
  };
  void AddColors(std::size_t index, const float* const* planes, std::uint32_t count);
  void AddPlanes(PlaneGroup group, const float* const* planes, std::uint32_t count,
                 std::span<double> sums);
  Rgb Sum(std::size_t index) const;
  Rgb UnitVariance(std::size_t index) const;
  Rgb ReplicateVariance(std::size_t index) const;

  std::size_t Index(int x, int y) const {
    return std::size_t(y - y0_) * std::size_t(width_) + std::size_t(x - x0_);
  }

  int x0_, y0_, width_, height_;
  SampleGroups groups_;
  double chance_of_light_ = 1;
  std::vector<std::uint64_t> samples_;
  std::vector<ReplicateSums> replicates_;  // with replicates
  std::vector<UnitSums> units_;            // without
  std::vector<Open> open_;                 // sums of incomplete pairs; without replicates
  std::vector<AovSums> aov_;
  std::vector<GbufferSums> gbuffer_;
  std::unique_ptr<BucketFilm> bucket_film_;
  std::unique_ptr<SplatFilm> splat_film_;
  FeatureSet features_;  // of renders that it takes samples of
  SamplePlanes planes_;  // that it takes
  std::unique_ptr<RegressionFilm> control_;
};

/// Calls visit(x, y) for every pixel.
template <class Visit>
void ForEachPixel(const PixelRect& rect, const Visit& visit) {
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) visit(x, y);
  }
}

inline PixelRect WindowOf(const FilmAccumulator& film) {
  return {film.x0(), film.y0(), film.x0() + film.width(), film.y0() + film.height()};
}
template <class Visit>
void ForEachPixel(const FilmAccumulator& film, const Visit& visit) {
  ForEachPixel(WindowOf(film), visit);
}

/// Samples of all pixels together.
inline double TotalSamples(const FilmAccumulator& film) {
  double samples = 0;
  ForEachPixel(film, [&](int x, int y) { samples += double(film.Samples(x, y)); });
  return samples;
}
/// Pixels of the film that have a sample.
inline std::uint64_t SampledPixels(const FilmAccumulator& film) {
  std::uint64_t count = 0;
  ForEachPixel(film, [&](int x, int y) { count += film.Samples(x, y) > 0; });
  return count;
}

}  // namespace lanelight
