// Tests that two images have the same mean, tile by tile: what a study holds a strategy's
// renders and its reference to, and a comparison any two images with variances.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "src/base/stat/hypothesis.h"

namespace lanelight {

/// Relative differences of means up to this are rounding of pixels to float.
inline constexpr double kFloatRounding = 1e-6;

/// Probability that tests of two images that are equal raise any false alarm.
inline constexpr double kBiasLevel = 1e-3;

/// Squares over an image, row by row: of 8 x 8 pixels, or larger, so that there are about
/// 1024 at most. Those at the far edges may be cut.
struct TileLayout {
  int side = 0, columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y / side) * columns + x / side;
  }
};

TileLayout LayoutOf(int width, int height);

/// How many times the variance of a mean of pixels with paths in common is that of
/// independent ones: the sum of the correlations of their errors. `squares`: the sum of
/// their squares (SampleGroups::dependents), which is known; of the pixels of a tile of
/// reuse=block, none is taken to be correlated more than the others.
double PixelsAsOne(double squares);

/// Mean of the variances of the tiles around one, five by five, with its degrees of
/// freedom (Welch and Satterthwaite; no mean): rare samples that the tile has missed have
/// fallen there.
stat::MeanEstimate VarianceAround(const TileLayout& layout,
                                  const std::vector<stat::MeanEstimate>& tiles,
                                  std::size_t tile);

/// Returns whether the mean of a tile rests on enough: (mean / standard error)^2 is how
/// many samples of equal value would scatter as much, and where a mean is made of rare
/// bright ones, an image may have missed them all, and its own scatter does not show it.
/// Also by the other's variance, of `other_per_own` times as many samples, if it has
/// more.
bool RestsOnEnough(const stat::MeanEstimate& own, const stat::MeanEstimate& other,
                   double other_per_own);

/// The z-score with the two-sided p-value of `p`, up to 9: beyond, all are the same to a
/// reader. Below zero where a < b.
double SignedZ(double p, const stat::MeanEstimate& a, const stat::MeanEstimate& b);

/// "side", "columns", "rows", and "z" in rows; null for NaN.
nlohmann::json TilesJson(const TileLayout& layout, const std::vector<double>& z);

}  // namespace lanelight
