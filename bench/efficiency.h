// Relative variance, time and efficiency of strategies from repeated renders, with
// bootstrap intervals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/core/vec.h"

namespace lanelight {

/// What the repetitions of one strategy on one scene gave.
struct Repetitions {
  std::string strategy;
  std::vector<std::vector<Rgb>> images;  // of different seeds
  std::vector<double> seconds;
  std::size_t bytes_per_path = 0;
  double occupancy = 0;       // lanes filled, over all stages
  std::uint64_t invalid = 0;  // samples that were not finite
  std::string refused;        // not empty: why the scene does not take the strategy
};

inline constexpr double kTrimmed = 0.01;

struct Estimate {
  double value = 0, low = 0, high = 0;  // 95 % interval
};

/// Each relative to the baseline: variance and time below 1 and efficiency above 1 are
/// better.
struct Comparison {
  Estimate variance, seconds, efficiency;
  /// Without the worst kTrimmed of the pixels of each render: where rare bright samples
  /// carry most of the variance, a few repetitions do not measure it, and no interval
  /// holds; this part of it is measured well.
  Estimate trimmed_variance, trimmed_efficiency;
  /// p-value of equal image means (Welch over the repetitions).
  double same_mean_p = 1;
};

/// `scale`: squared pixel values of the scene that errors are relative to.
std::vector<double> PixelScales(const std::vector<Repetitions>& all);

/// Mean over pixels of the squared error of each repetition against the mean of the
/// others, corrected to the variance of one render, relative to `scales`; the largest
/// errors, a share of `trimmed`, left out.
std::vector<double> RelativeErrors(const Repetitions& r,
                                   const std::vector<double>& scales, double trimmed);

Comparison Compare(const Repetitions& r, const Repetitions& baseline,
                   const std::vector<double>& scales);

double Median(std::vector<double> values);

}  // namespace lanelight
