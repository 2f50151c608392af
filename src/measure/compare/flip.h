// FLIP: how different two images look to somebody who flips between them in one place.
// 0: alike, 1: as different as can be. For images as a screen shows them Andersson,
// Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild (2020), "FLIP: A Difference
// Evaluator for Alternating Images"; for those of a high dynamic range Andersson,
// Nilsson, Shirley and Akenine-Moller (2021), "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "src/base/core/pi.h"
#include "src/measure/compare/linear_image.h"

namespace lanelight {

/// Pixels in a degree of the eye's field: of a screen 0.7 m wide with 3840 pixels, seen
/// from 0.7 m, as in the papers; 67.02.
inline constexpr double kFlipPixelsPerDegree = 3840 * kPi / 180;

/// Of each pixel, as the screen shows the images: values clamped to 0 ... 1 (a NaN to 0).
/// Symmetric in the two. `pixels_per_degree`: 1 to 1000.
Plane LdrFlip(const LinearImage& reference, const LinearImage& test,
              double pixels_per_degree = kFlipPixelsPerDegree);

/// Exposures, in powers of two, at which images of a high dynamic range are looked at.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 0;
};

/// From where the tone curve brings the brightest pixel of the reference to 0.85, to
/// where it does so with the median. One step of 1 without any light.
FlipExposures ExposuresOf(const LinearImage& reference);

/// Of each pixel the largest of all exposures, by the tone curve of ACES (Narkowicz's
/// fit). Not symmetric: the exposures are those of the reference.
Plane HdrFlip(const LinearImage& reference, const LinearImage& test,
              const FlipExposures& exposures,
              double pixels_per_degree = kFlipPixelsPerDegree);

/// A map in few numbers. Quartiles are weighted: the errors up to the median are half of
/// the sum of all errors. 0 where all errors are.
struct FlipSummary {
  double mean = 0, first_quartile = 0, median = 0, third_quartile = 0, max = 0;
};

FlipSummary SummaryOf(const Plane& map);

}  // namespace lanelight
