// How the error falls with the number of samples, and when it reaches a target.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/base/stat/interval.h"

namespace lanelight::stat {

/// The repetitions of one strategy at one sample count: mean squared errors (or relative
/// ones) and seconds, by repetition; the same seeds at every count.
struct Level {
  double samples = 0;
  std::vector<double> error, seconds;
};

/// Order of convergence: slope of log(sqrt(error)) over log(samples), -0.5 for
/// independent samples. Least squares through each repetition by itself; its mean over
/// the repetitions with Student's t interval, which needs no model of how errors of
/// different counts depend on each other. Empty below two levels; levels or repetitions
/// with an error that is not positive are left out. Without bounds for one repetition.
std::optional<Interval> FitOrder(std::span<const Level> levels, double confidence);

/// Samples and seconds until the mean error is `target`.
struct TargetCost {
  Interval samples, seconds;
  /// The target lies outside the measured counts: the fitted order continues the curve.
  bool extrapolated = false;
};

/// Interpolates log error linearly over log samples, and log seconds over log samples,
/// between the levels on both sides; beyond them continues with the least-squares slope,
/// by at most a factor `reach` in samples. A curve that crosses the target more than once
/// counts from where it stays below. The intervals are of the logarithms, by HalfWidth()
/// (src/base/stat/bootstrap.h) over whole repetitions, those that all levels have;
/// without bounds if these are fewer than two. Levels with a mean error that is not
/// positive are left out. Empty if the target is out of reach, the fitted error does not
/// fall, or there are fewer than two usable levels (one if it is met exactly).
std::optional<TargetCost> CostToTarget(std::span<const Level> levels, double target,
                                       double confidence, double reach = 1000);

}  // namespace lanelight::stat
