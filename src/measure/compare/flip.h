// FLIP: the perceived difference of two images shown in alternation, from 0 (equal) to 1.
// For images as a screen shows them Andersson,
// Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild (2020), "FLIP: A Difference
// Evaluator for Alternating Images"; for those of a high dynamic range Andersson,
// Nilsson, Shirley and Akenine-Moller (2021), "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "src/base/core/pi.h"
#include "src/measure/compare/linear_image.h"

namespace lanelight {

/// Pixels per degree of visual angle of a screen 0.7 m wide with 3840 pixels, seen from
/// 0.7 m, as in the papers; 67.02.
inline constexpr double kFlipPixelsPerDegree = 3840 * kPi / 180;

/// Returns FLIP of each pixel, with values clamped to 0 ... 1 (a NaN to 0). Symmetric.
/// `pixels_per_degree`: 1 to 1000.
Plane LdrFlip(const LinearImage& reference, const LinearImage& test,
              double pixels_per_degree = kFlipPixelsPerDegree);

/// Exposures for images of a high dynamic range, in powers of two.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 0;
};

/// Returns exposures from where the tone curve maps the brightest pixel of the reference
/// to 0.85, to where it does so for the median. One step of 1 for a black reference.
FlipExposures ExposuresOf(const LinearImage& reference);

/// Returns the largest FLIP of each pixel over all exposures, by the tone curve of ACES
/// (Narkowicz's fit). Not symmetric: the exposures are those of the reference.
Plane HdrFlip(const LinearImage& reference, const LinearImage& test,
              const FlipExposures& exposures,
              double pixels_per_degree = kFlipPixelsPerDegree);

/// Statistics of a map. Quartiles are weighted by error: errors up to the median are half
/// of the sum of all errors.
struct FlipSummary {
  double mean = 0, first_quartile = 0, median = 0, third_quartile = 0, max = 0;
};

FlipSummary SummaryOf(const Plane& map);

}  // namespace lanelight
