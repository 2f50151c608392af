// How far a render is from the converged image, estimated from its own samples.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "src/core/vec.h"
#include "src/image/accumulator.h"
#include "src/stat/interval.h"

namespace lanelight {

/// Added to the squared mean in the relative error, as in src/estimate/metrics.h.
inline constexpr double kRelativeEpsilon = 0.01;

/// Estimates of what `lanelight compare` would measure against the converged image, with
/// intervals that contain it with probability kEstimateConfidence.
inline constexpr double kEstimateConfidence = 0.95;

/// Where the samples cannot tell an upper end, it is infinite, and `low` is what the
/// error is at least, with probability kEstimateConfidence: see Doubts.
struct ErrorEstimate {
  bool available = false;     // at least one pixel has two independent observations
  bool has_interval = false;  // `rmse` and `relmse` both have an upper end
  Interval rmse;              // sqrt(mean of the variance of the pixel mean)
  Interval relmse;            // mean of variance / (mean^2 + kRelativeEpsilon)
  std::string why;            // an upper end is missing; empty if none is
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
/// what remains of the bias was measured to be below that (bench/calibrate/).
///
/// Variance and weight of a pixel are not independent: rare samples are bright ones, so
/// that a pixel's mean is high when its variance is. To first order that takes
/// 2 gamma sqrt(r) of a pixel's relative error r away, gamma being the skewness of its
/// mean; over scenes the loss was found to be near kSkew sqrt(relmse), which is given
/// back, and the interval is widened by kSkewDoubt of it.
///
/// Pixels half seen by a lamp, whose neighbours are no guide, are beyond this: they are
/// not left to the samples (src/wavefront/seen_lights.h).
///
/// Holds for two groups or more, best for four. What no group has sampled cannot be seen:
/// where few pixels carry the error, or where it hangs on how dark noisy pixels really
/// are, the brightest paths are likely to be still missing. Then there is no upper end
/// (kLeastEffectivePixels, kMostDoubt), only a lower one.
ErrorEstimate EstimateError(const FilmAccumulator& film);
inline constexpr double kWeightDoubt = 0.3;
inline constexpr double kSkew = 0.35, kSkewDoubt = 0.35;
/// What the weights may be wrong by even where nothing else is in doubt.
inline constexpr double kLeastDoubt = 0.02;
/// Fewer effective pixels, and there is no upper end.
inline constexpr double kLeastEffectivePixels = 5;
/// Nor if shrinking changes log(relmse) by more.
inline constexpr double kMostWeightChange = 1.5;
/// By how much the relative error may grow if every pixel's true value were nearer to
/// zero by its standard deviation, given the pixel and its neighbours; of one pixel
/// kMostDarker counts. Beyond, weights are not known: glossy highlights of small lamps,
/// whose neighbours are no guide. Measured: at most 0.53 in scenes whose intervals hold,
/// 0.6 and more where they do not (bench/calibrate/).
inline constexpr double kMostDoubt = 0.55, kMostDarker = 50;

/// The same for any source of pixels, x in [0, width), y in [0, height), which may be
/// asked from several threads at once.
ErrorEstimate EstimateError(int width, int height,
                            const std::function<PixelEstimate(int x, int y)>& pixel);

/// Interval of the true error: the estimate times quantiles of the F distribution with
/// k1 and k2 degrees of freedom, these being widened by `doubt` >= 0, the standard half
/// width (of 95 %) of an independent factor's logarithm.
Interval ErrorInterval(double estimate, double k1, double k2, double doubt = 0);

}  // namespace lanelight
