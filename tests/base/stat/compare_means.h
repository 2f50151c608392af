// Are two rendered images equal in the mean? Welch's t-test per tile and channel and over
// the whole image, with one false-alarm budget for all of them (after Subr and Arvo 2007;
// Jung, Hanika and Dachsbacher 2020).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/base/core/vec.h"

namespace lanelight::stat {

/// Pixel means with the estimated variance of each mean. `observations`: independent
/// observations per pixel behind the variance (groups, not samples, where samples are
/// dependent). A known image has zero variance.
struct ImageEstimate {
  int width = 0, height = 0;
  double observations = 0;
  std::vector<Rgb> mean, variance;
};

/// An image of known values, from a closed form f(x, y) at pixel (x, y).
ImageEstimate ExpectedImage(int width, int height, const std::function<Rgb(int, int)>& f);

struct ImageTestOptions {
  int tile = 4;                   // pixels per side; the last tiles may be smaller
  double false_alarm = 1e-6;      // probability, for the whole comparison
  double relative_tolerance = 0;  // of the larger of the two means
  double absolute_tolerance = 0;
};

struct ImageTestResult {
  bool same = false;
  int tests = 0;     // tiles * 3 + 3
  double level = 0;  // per test
  double smallest_p = 1;
  std::string worst;  // where, and what was seen there
  /// p-value of the KS test that the tile p-values (green) are uniform; 1 if there are
  /// fewer than 8 noisy tiles. Not part of `same`.
  double uniformity_p = 1;
  /// Power: the smallest relative error of the whole image (luminance-like mean of the
  /// channels) that the whole-image test detects with probability 0.95.
  double detectable_bias = 0;
  std::string ToString() const;
};

/// Compares two images of the same size.
ImageTestResult CompareMeans(const ImageEstimate& a, const ImageEstimate& b,
                             const ImageTestOptions& options = {});

/// Requires that a comparison found no difference; with `power`, that it would have
/// detected a relative error of that size. `what` is printed with a failure.
void CheckSame(const ImageTestResult& result, const std::string& what = "");
void CheckSame(const ImageTestResult& result, double power, const std::string& what = "");

}  // namespace lanelight::stat
