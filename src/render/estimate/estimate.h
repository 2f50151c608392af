// Estimates the error of a render from its own samples.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/base/stat/interval.h"
#include "src/base/stat/relative_error.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// Probability that an interval contains the true error.
inline constexpr double kEstimateConfidence = 0.95;

/// ErrorEstimate::why of an image whose samples are all black.
inline constexpr const char* kNoLight =
    "no light reached the image; does the scene have a light?";

/// Estimates of what `lanelight compare` would measure against the converged image. Where
/// the samples do not give an upper end, it is infinite; `low` remains a lower bound.
struct ErrorEstimate {
  bool available = false;     // every pixel has two independent observations
  bool has_interval = false;  // `rmse` and `relmse` both have an upper end
  Interval rmse;              // sqrt(mean of the variance of the pixel mean)
  Interval relmse;            // mean of variance / (mean^2 + kRelativeEpsilon)
  std::string why;            // an upper end is missing, and what would give it; or empty
  std::uint64_t pixels = 0;   // that the estimate rests on
  /// Effective sample size, in pixels: small if few pixels carry most of the error.
  double effective_pixels = 0;
};

/// An estimate of one pixel. `known`: it has two independent observations. An image in
/// which only some pixels are known has no estimate.
struct PixelEstimate {
  bool known = false;
  Rgb mean, variance;  // `variance` >= 0: estimated, of the mean
  double freedom = 1;  // degrees of freedom of `variance`: observations - 1, at least 1
};

/// Averages run over the pixels with a variance and over the three channels.
///
/// With m the mean of G independent groups (a pixel) around mu and v = s^2 / G, the
/// difference (m - mu)^2 - v is 1 / (G (G - 1)) times the sum of the products of
/// different groups' deviations, so its variance is 2 sigma^4 / (G (G - 1)) whatever the
/// distribution: a bright sample that is in m is in v as well. Pixels being independent,
/// true over estimated error is close to an F variable with k1 = (sum t)^2 / sum t^2 and
/// k2 = (sum t)^2 / sum (t^2 / (G - 1)) degrees of freedom (Satterthwaite 1946), t being
/// the share of a pixel, its channels together. s^4 (G - 1) / (G + 1) stands for sigma^4
/// (and (sum t)^2 is less its own variance, so that one pixel has k1 = 1, k2 = G - 1),
/// too large for long-tailed distributions: where rare samples carry the error, intervals
/// are wide and cover more than they say.
///
/// The relative error divides by the unknown mu^2 + kRelativeEpsilon. The estimate
/// replaces m, whose error is also that of v, by the mean of m and the mean n of the
/// eight neighbours with weights a and v. a is the mean of (m - n)^2 - v around the
/// pixel, at least 0 (empirical Bayes with the neighbourhood as prior). Its variance is b
/// = a v / (a + v). The distribution of mu is taken to be a gamma distribution of this
/// mean and variance, of shape at least 1: mean^2 / variance counts the bright samples
/// that a pixel has met, and it has met one. The median of mu gives the estimate. The
/// increase of v / (mu^2 + kRelativeEpsilon) at the lower end of mu is what a pixel may
/// add. The additions of independent pixels are squared, summed, and joined with the
/// upper end (method of variance estimates recovery, Zou and Donner 2008). A few pixels
/// with one bright sample each, as at the edge of a lamp, thus widen the interval upwards
/// by what they cost if they are really dark.
///
/// The mean n is noisy as well where the noise is as large as the image. Then 1 / n^2 is
/// too large on average, by 3 var(n) / n^4 to second order; 1 / (n^2 + 3 var(n)) is not.
/// The other extreme is the estimate with weights a and the neighbourhood's mean
/// variance, which does not mistake a pixel without bright samples for one without noise.
/// The logarithm of their ratio moves the lower end, as variances add.
///
/// Variance and weight of a pixel are not independent: rare samples are bright ones, so
/// that a pixel's mean is high when its variance is. To first order that takes
/// 2 gamma sqrt(r) of a pixel's relative error r away, gamma being the skewness of its
/// mean; over scenes the loss was found to be kSkew sqrt(relmse) up to kMaxSkewError,
/// give or take kSkewUncertainty sqrt(relmse) (bench/calibrate/): the former is given
/// back, the latter widens the interval.
///
/// Holds for two groups or more, best for four. What no group has sampled cannot be seen.
/// There is no upper end if it is more than kMaxUpperRatio times the estimate. There is
/// none either if directions find lamps by chance alone and all samples together are
/// expected to meet lamps less than kMinExpectedMeetings times: no estimate contains
/// light that no sample has met.
///
/// `stop`: once it is set, nothing more is computed, and what is returned says nothing
/// (`available` is false); null: never.
ErrorEstimate EstimateError(const FilmAccumulator& film,
                            const std::atomic<bool>* stop = nullptr);
inline constexpr double kMaxUpperRatio = 32, kMinExpectedMeetings = 50;
inline constexpr double kSkew = 0.3, kSkewUncertainty = 0.5, kMaxSkewError = 0.01;

/// Estimates from any source of pixels of the window, which is called from several
/// threads at once. `dependents`: see SampleGroups; pixels count for less by this factor.
ErrorEstimate EstimateError(const PixelRect& window,
                            const std::function<PixelEstimate(int, int)>& pixel,
                            double dependents = 1,
                            const std::atomic<bool>* stop = nullptr);

/// Interval of the true error: the estimate times quantiles of the F distribution with
/// k1 and k2 degrees of freedom.
Interval ErrorInterval(double estimate, double k1, double k2);

/// Limits of the true error; 0 = none.
struct ErrorTarget {
  double relmse = 0, rmse = 0;
  bool Any() const { return relmse > 0 || rmse > 0; }
};

/// Returns whether the upper ends of the estimate's intervals are below the target.
bool Reached(const ErrorTarget& target, const ErrorEstimate& estimate);

/// Returns whether the estimate has no upper end although kHopelessFactor times as many
/// samples were taken as its value asks for.
bool IsHopeless(const ErrorTarget& target, const ErrorEstimate& estimate);
inline constexpr double kHopelessFactor = 64;

/// Returns the samples per pixel that the target is expected to take, of which `done` are
/// taken: squared errors fall like 1 / samples. At most `done` if it is reached, more if
/// not; infinite without an upper end; below 0 if there will be none (IsHopeless).
double SamplesNeeded(const ErrorTarget& target, const ErrorEstimate& estimate,
                     std::uint64_t done);

}  // namespace lanelight
