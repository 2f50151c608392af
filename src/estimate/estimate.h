// How far a render is from the converged image, estimated from its own samples.
#pragma once

#include <cstdint>
#include <functional>

#include "src/core/vec.h"
#include "src/image/accumulator.h"
#include "src/stat/interval.h"

namespace lanelight {

/// Added to the squared mean in the relative error, as in src/estimate/metrics.h.
inline constexpr double kRelativeEpsilon = 0.01;

/// Estimates of what `lanelight compare` would measure against the converged image, with
/// intervals that contain it with probability kEstimateConfidence.
inline constexpr double kEstimateConfidence = 0.95;
struct ErrorEstimate {
  bool available = false;     // at least one pixel has two independent observations
  bool has_interval = false;  // the same
  Interval rmse;              // sqrt(mean of the variance of the pixel mean)
  Interval relmse;            // mean of variance / (mean^2 + kRelativeEpsilon)
  std::uint64_t pixels = 0;   // that the estimate rests on
  /// Pixels of equal relative error that would scatter as much: few if few pixels carry
  /// most of the error.
  double effective_pixels = 0;
};

/// What is known of one pixel; `known` false leaves it out.
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
/// The relative error divides by the unknown mu^2 + kRelativeEpsilon. In place of m,
/// whose error is that of v too, stands the mean of m and the mean n of the eight
/// neighbours with weights a and v, a being the mean of (m - n)^2 - v around the pixel
/// (at least 0): empirical Bayes with the neighbourhood as prior. The interval is widened
/// by kWeightDoubt times the change in log(relmse) that this makes, as variances add:
/// what remains of the bias was measured to be below that (bench/calibrate.cc).
///
/// The relative error is underestimated, and its interval too low, where pixels half seen
/// by a small bright light carry it: their neighbours are no guide, and their own mean is
/// high when their variance is (scenes/cornell-box.pbrt, the edge of the lamp: true error
/// 1.3 times the estimate at 32 samples per pixel of 64 x 48, 1.15 at 64). The RMSE,
/// which has no weights, is right there.
///
/// Holds for two groups or more, best for four. What no group has sampled cannot be seen:
/// as long as the brightest paths are so rare that most renders miss them, the true error
/// is above the interval in those.
ErrorEstimate EstimateError(const FilmAccumulator& film);
inline constexpr double kWeightDoubt = 0.4;
/// What the weights may be wrong by even where shrinking changes nothing: measured biases
/// of 2 to 11 % on images of 30 000 pixels, whose F interval alone is +-2 %.
inline constexpr double kLeastDoubt = 0.07;

/// The same for any source of pixels, x in [0, width), y in [0, height), which may be
/// asked from several threads at once.
ErrorEstimate EstimateError(int width, int height,
                            const std::function<PixelEstimate(int x, int y)>& pixel);

/// Interval of the true error: the estimate times quantiles of the F distribution with
/// k1 and k2 degrees of freedom, these being widened by `doubt` >= 0, the standard half
/// width (of 95 %) of an independent factor's logarithm.
Interval ErrorInterval(double estimate, double k1, double k2, double doubt = 0);

}  // namespace lanelight
