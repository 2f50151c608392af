// Finds how the error of a strategy falls with the number of samples: as 1 / N or more
// slowly, and which pixels cause that.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/measure/compare/linear_image.h"
#include "src/measure/sweep/results.h"

namespace lanelight {

/// Renders of one strategy with equal seeds at several sample counts.
struct ErrorCurve {
  std::vector<double> samples;  // per pixel, ascending
  std::size_t seeds = 0;
  bool half = false;  // the files have 16 bits per colour
  /// Returns the image at a count (index of `samples`) with a seed. All have one size.
  std::function<LinearImage(std::size_t count, std::size_t seed)> image;
};

struct BlamedPixel {
  int x = 0, y = 0;
  double share = 0;  // of the squared error
};

/// kExact: even the fewest samples have no more error than rounding in the file.
enum class Fall { kAsExpected, kSlower, kUndecided, kExact };
enum class FallCause { kNone, kRounding, kHeavyTails, kUnknown };

struct Convergence {
  std::vector<double> samples;
  std::vector<Interval> relmse;  // by count
  /// Errors fall as N^-order: between each count and the next, and over all counts. 1 for
  /// independent samples. Unknown if the images of all seeds are equal.
  std::vector<Interval> orders;
  Interval order = WithoutBounds(0);
  Fall fall = Fall::kUndecided;
  std::size_t from = 0;  // of kSlower: index of the count
  FallCause cause = FallCause::kNone;
  double rounding = 0;  // relative MSE of numbers in the files, by their precision
  /// Shares of the squared error at the largest count, in the worst 0.1 % of the pixels
  /// (at least one) and in the worst 1 %.
  double worst_share = 0, percent_share = 0;
  /// Skewness of the worst 1 % over the seeds: 0 for normal means, positive if rare
  /// samples are bright. Weighted by error; mean over the counts.
  double skewness = 0;
  /// Fraction of the error of the worst 1 % in pixels that are among the worst 1 % in
  /// both halves of the seeds.
  double repeated = 0;
  std::vector<BlamedPixel> pixels;  // the worst, at most kMaxBlamed
};
inline constexpr std::size_t kMaxBlamed = 5;

/// Fewest seeds of a curve. It has at least two counts.
inline constexpr std::size_t kMinCurveSeeds = 4;

/// Analyses a curve. The error of a seed's image is its relative squared distance from
/// the mean of the other seeds at the largest count, less that mean's own error. It is at
/// least what rounding in the file costs. Orders are means over seeds
/// (stat::FitOrder). The fall is slower than 1 / N if the order of a step, or that from a
/// count to the last, is significantly below kMinOrder. Rounding is named if it makes up
/// a quarter of the last error, however that falls.
///
/// The worst 1 % of the pixels have heavy tails if their means are significantly skewed:
/// too few samples for a normal distribution. These are the cause if the fall is slower
/// or not decided, and are named as well if 0.1 % of the pixels carry more than
/// kHeavyTail of the error. Selection by variance does not affect the test, since the
/// skewness of normal samples is independent of their variance.
///
/// At most 5 % of curves of normal errors that fall as 1 / N are blamed: half of that for
/// orders (Sidak's correction), half for skewness.
Convergence AnalyseCurve(const ErrorCurve& curve);
inline constexpr double kMinOrder = 0.9;

/// Analyses the first 1000 curves of a sweep, of at most 16 seeds each, from the images
/// of its cells. Skips curves whose images cannot be read. docs/sweep.md has the members.
nlohmann::json ConvergenceJson(const Sweep& sweep, const SweepFolder& folder,
                               const std::vector<CellGroup>& groups);

/// Returns a line for each of the first curves that fall more slowly than 1 / N, and one
/// that counts the others; empty without curves.
std::string ConvergenceText(const nlohmann::json& curves);

}  // namespace lanelight
