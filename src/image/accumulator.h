// The film: sums in double, per pixel and channel, of group means, so that a million
// samples lose nothing and dependent samples (one randomisation of a low-discrepancy
// sequence) count as one observation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/core/state.h"
#include "src/core/vec.h"
#include "src/image/control_film.h"
#include "src/path/sample_planes.h"

namespace lanelight {

/// How much the samples of a pixel scatter, by the means of groups of them: samples of a
/// group depend on each other and count as one observation. Apart from the film's sums,
/// which know nothing of groups.
struct GroupScatter {
  double open[3] = {};     // sum of the incomplete group
  double squares[3] = {};  // of the means of complete groups
  double total[3] = {};    // of these means
  std::uint64_t groups = 0;

  /// Closes the open group of `size` samples in one channel; its mean.
  double Close(int channel, std::uint32_t size) {
    const double mean = open[channel] / size;
    AddMean(channel, mean);
    open[channel] = 0;
    return mean;
  }
  void AddMean(int channel, double mean) {
    squares[channel] += mean * mean;
    total[channel] += mean;
  }
  /// Sample variance of the means.
  double Variance(int channel) const;
};

class FilmAccumulator {
 public:
  /// A film of the pixels [x0, x0+width) x [y0, y0+height) of the full image.
  /// Samples `k*group_size ... (k+1)*group_size - 1` of a pixel form one group.
  FilmAccumulator(int x0, int y0, int width, int height, std::uint32_t group_size,
                  bool aov);

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::uint32_t group_size() const { return group_size_; }
  bool has_aov() const { return !aov_.empty(); }

  /// From here on (before any sample), samples have three further planes after all
  /// others: the difference h - E[h] of a control variate whose coefficient the film
  /// fits. After FitControl, Mean and Variance are those of the corrected samples.
  void UseControl();
  void FitControl();
  /// What the control variate achieved; empty without UseControl.
  std::optional<ControlReport> Control() const;

  /// Changes the size of the groups: all samples so far, which must be fewer than that,
  /// begin the first one. Nothing if the size is the same.
  void Regroup(std::uint32_t group_size);

  /// Planes that a film takes of a sample, at most.
  static constexpr int kMostPlanes =
      kColorPlanes + kAovPlanes + NumPlanes(PlaneGroup::kDifference);

  /// Adds `count` consecutive samples of one pixel; planes[p][i] is plane p (in the order
  /// of SamplePlanes) of the i-th. Must be called with the samples of a pixel in order.
  /// Safe for different pixels from different threads.
  void AddSamples(int x, int y, const float* const* planes, std::uint32_t count);

  std::uint64_t Samples(int x, int y) const { return pixel(x, y).samples; }
  /// Mean of all samples; zero without samples.
  Rgb Mean(int x, int y) const;
  /// Estimated variance of Mean() per channel, from the scatter of complete groups;
  /// NaN-free: zero where fewer than two groups are complete (see HasVariance).
  Rgb Variance(int x, int y) const;
  bool HasVariance(int x, int y) const { return Groups(x, y) >= 2; }
  /// Complete groups of a pixel.
  std::uint64_t Groups(int x, int y) const { return pixel(x, y).scatter.groups; }
  /// Estimate of the variance of Mean() less Variance(), which takes the samples of an
  /// incomplete group for as good as those of a complete one. They are less well
  /// stratified: the square of their distance d from the others, which make up a share s
  /// of all samples, adds (1 - s)^2 d^2 - (1 - s) / s Variance(). Zero without an
  /// incomplete group; unbiased, and of either sign.
  Rgb OpenGroupExcess(int x, int y) const;
  /// Mean of an auxiliary plane.
  double Aov(int x, int y, int plane) const;

  /// All that AddSamples has brought, exactly. A film of the same pixels, planes and
  /// group size goes on from there; Restore throws InputError for another.
  void Save(StateWriter& state) const;
  void Restore(StateReader& state);

 private:
  struct Pixel {
    double sum[3] = {};
    std::uint64_t samples = 0;
    GroupScatter scatter;
  };
  static void AddGroupsOfOne(const float* const* planes, std::uint32_t count, Pixel& p);
  template <bool kControl>
  void AddColors(std::size_t index, const float* const* planes, std::uint32_t count);

  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y - y0_) * width_ + (x - x0_);
  }
  const Pixel& pixel(int x, int y) const { return pixels_[Index(x, y)]; }

  int x0_, y0_, width_, height_;
  std::uint32_t group_size_;
  std::vector<Pixel> pixels_;
  std::vector<double> aov_;  // kAovPlanes sums per pixel
  SamplePlanes planes_;      // that it takes
  std::optional<ControlFilm> control_;
};

}  // namespace lanelight
