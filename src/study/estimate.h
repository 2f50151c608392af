// How far a render is from the converged image, estimated from its own samples.
#pragma once

#include <cstdint>
#include <functional>

#include "src/core/vec.h"
#include "src/image/accumulator.h"
#include "src/stat/interval.h"

namespace lanelight {

/// Added to the squared mean in the relative error, as in src/study/metrics.h.
inline constexpr double kRelativeEpsilon = 0.01;

/// Estimates of what `lanelight compare` would measure against the converged image.
struct ErrorEstimate {
  bool available = false;     // at least one pixel has two complete groups of samples
  bool has_interval = false;  // at least two tiles
  Interval rmse;              // sqrt(mean of the variance of the pixel mean)
  Interval relmse;            // mean of variance / (mean^2 + kRelativeEpsilon)
  std::uint64_t pixels = 0;   // that the estimate rests on
  std::uint64_t tiles = 0;
  int tile = 0;  // pixels per side of a tile
};

/// Mean and variance of the mean of one pixel; `known` false leaves it out.
struct PixelEstimate {
  bool known = false;
  Rgb mean, variance;
};

/// Averages run over the pixels with a variance and over the three channels. The
/// intervals are Student t intervals over the means of square tiles of 8 x 8 pixels
/// (fewer if the image has fewer than 16 such tiles), cut off at zero; the interval of
/// the RMSE is the square root of that of its square. Pixels are independent, so tile
/// means are close to normal unless rare bright samples dominate; then the true error is
/// likely above the interval, because what has not been sampled yet cannot be seen.
///
/// The relative error divides by the estimated mean, which biases it pixel by pixel: a
/// relative bias of +3 g for symmetric noise and of -g for exponential noise, with
/// g = variance / mean^2 (second-order expansion). It is not corrected, since its sign
/// depends on the skewness, which the film does not record.
ErrorEstimate EstimateError(const FilmAccumulator& film);

/// The same for any source of pixels, x in [0, width), y in [0, height).
ErrorEstimate EstimateError(int width, int height,
                            const std::function<PixelEstimate(int x, int y)>& pixel);

/// Quantile 0.975 of Student's t distribution with `degrees` >= 1 degrees of freedom;
/// relative error below 1e-3 (tested).
double StudentQuantile975(std::uint64_t degrees);

}  // namespace lanelight
