// The fit of control=regression (kernels/control/regression.cc): polynomials in the
// numbers of a path's first choices, and these choices themselves, fitted to one half of
// a pixel's samples and its neighbours', are subtracted from the other half.
//
//   estimator   1/n (sum over half A of (f - c b_B.phi) + sum over half B of
//               (f - c b_A.phi)), b_X by least squares from the samples of half X
//   functions   phi_j: Legendre polynomials, orthonormal over uniform numbers, of degree
//   1
//               in the position in the pixel (2 functions); 1 and 2 in each of the
//               numbers of the first scattered direction, and the product (5); 1 in those
//               of the point on a light at the same event, and the product (3); the first
//               two choices between lobes (2). Each has mean 0 whatever the path did
//               before, and so any two are uncorrelated: least squares is b_j = Cov(f,
//               phi_j) / E[phi_j^2], function by function
//   unbiased    b_B depends on samples that are independent of half A, where phi has mean
//               0: E[b_B.phi] = 0 (a fit to the samples that it corrects is off by E[b
//               phi], of order (skewness) / n)
//   variance    1 - c (2 - c) R^2 of that without control, least at c = 1 whatever the
//               scene, and O(functions / n) of it for the errors of the coefficients
//
// Sums are of a half's samples in their order, so that they do not depend on how these
// come in. Single-precision sums that only coefficients need end with kMaxFittedSamples
// samples, after which coefficients hardly change.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/vocabulary/path/dimensions.h"
#include "src/vocabulary/path/replicates.h"

namespace lanelight {

struct ReplicateSums {
  double of[kReplicates][3] = {};

  double Total(int channel) const {
    double total = 0;
    for (const auto& sum : of) total += sum[channel];
    return total;
  }
  /// Returns the estimated variance of Total() / samples in one channel. The variance of
  /// a replicate's sum is taken to be proportional to its samples n_r. With the
  /// deviations D_r from n_r times the mean, E[sum D_r^2] is then that of one sample
  /// times n - sum n_r^2 / n.
  double VarianceOfMean(int channel, std::uint64_t samples,
                        const SampleGroups& groups) const;
};

inline double ReplicateSums::VarianceOfMean(int channel, std::uint64_t samples,
                                            const SampleGroups& groups) const {
  const double n = double(samples), mean = Total(channel) / n;
  double squares = 0, freedom = n;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    const double own = double(groups.InReplicate(samples, r));
    const double deviation = of[r][channel] - own * mean;
    squares += deviation * deviation;
    freedom -= own * own / n;
  }
  return squares / (freedom * n);
}

/// Effect of control=regression over an image.
struct ControlReport {
  double coefficient = 0;  // c above; the paper's equation 7 has the opposite sign
  double correlation = 0;  // of f and its fit, over the variance of all pixels, channels
};

/// Sums of f that the film keeps and a fit needs.
struct ControlledColors {
  const std::vector<std::uint64_t>& samples;
  const std::vector<ReplicateSums>& replicates;  // empty without replicates
};

/// Consecutive samples of one pixel, plane by plane.
struct ControlledSamples {
  std::uint64_t first = 0;  // number of the first one
  std::uint32_t count = 0;
  const float* const* colors = nullptr;
  const float* const* planes = nullptr;  // the numbers
};

/// Sums of one film, by pixel index y * width + x. The halves alternate between units of
/// samples, or between replicates (src/vocabulary/path/replicates.h).
class RegressionFilm {
 public:
  /// The bits of codes (src/vocabulary/path/dimensions.h): position in the pixel,
  /// direction, point on a light, choices.
  static constexpr int kPlanes = kFirstNumbers;
  static constexpr int kFunctions = 12;
  /// Pixels of a block (kBlock x kBlock, from the image's origin on) share information,
  /// so the result is the same for any split of the render.
  static constexpr int kBlock = 4;
  static constexpr std::uint64_t kMaxFittedSamples = std::uint64_t{1} << 20;

  /// Requires units of single samples, or replicates (GroupsOf).
  RegressionFilm(const PixelRect& window, const SampleGroups& groups, double coefficient);
  static std::size_t BytesPerPixel(const SampleGroups& groups);

  /// Evaluates the functions.
  static void Functions(const float* codes, float* phi);

  /// Adds a pixel's samples, in order. Safe for different pixels from different threads.
  void Add(std::size_t pixel, const ControlledSamples& samples);
  /// Fits the coefficients to all samples so far; before, they are 0.
  void Fit(const ControlledColors& colors);
  /// Returns what to subtract from the sum of f over all `samples` samples.
  Rgb Correction(std::size_t pixel, std::uint64_t samples) const;
  /// Subtracts the same from the sums of its replicates.
  void CorrectReplicates(std::size_t pixel, ReplicateSums& sums) const;
  /// Returns the sum of squares of the corrected units about their mean. Without
  /// replicates.
  Rgb ResidualSquares(std::size_t pixel, std::uint64_t samples) const;
  ControlReport Report(const ControlledColors& colors) const;
  /// Returns all that has been added; coefficients are not part of it.
  std::vector<MutableStateColumn> Columns();

 private:
  using Values = std::array<float, kFunctions>;
  struct Colors {
    double f[3] = {}, ff[3] = {};
  };
  // Over the first kMaxFittedSamples samples, of which a half has half.
  struct Products {
    Values squares = {}, products[3] = {};  // of phi, of f and phi
    Values once = {}, twice = {};           // of g phi^2, of g^2 phi^2; g: mean of f
  };
  template <class T>
  using Halves = std::array<T, 2>;
  // Results of a fit, by channel.
  struct Fitted {
    float corrections[kReplicates][3] = {};
    float products[3] = {}, squares[3] = {};  // sums of f times the fit, of its square
  };
  struct Scatter;

  std::uint32_t ReplicateOf(std::uint64_t sample) const {
    return std::uint32_t(sample / groups_.unit % replicates_);
  }
  const Values& Sums(std::size_t pixel, std::size_t replicate) const {
    return sums_[pixel * replicates_ + replicate];
  }
  double SamplesOfHalf(std::uint64_t samples, int half) const;
  Scatter ScatterOf(const ControlledColors& colors, std::size_t pixel, int half) const;
  void AddHalf(std::size_t pixel, std::uint32_t half, const ControlledSamples& samples,
               std::uint32_t begin, std::span<const float[kFunctions]> phi);
  void FitBlock(const ControlledColors& colors, std::span<const std::size_t> pixels);
  void StoreCoefficients(const Values (&b)[3], std::size_t pixel, std::uint64_t samples,
                         int half);

  PixelRect window_;
  SampleGroups groups_;
  double coefficient_;
  std::uint32_t replicates_;  // replicates, or halves
  std::vector<Values> sums_;  // of phi, by pixel and turn
  std::vector<Halves<Colors>> colors_;
  std::vector<Halves<Products>> products_;
  std::vector<Fitted> fitted_;
};

}  // namespace lanelight
