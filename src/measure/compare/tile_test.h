// Tests whether two images have the same mean in every tile, for studies and comparisons.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "src/base/stat/hypothesis.h"

namespace lanelight {

/// Largest relative difference of means by rounding pixels to float.
inline constexpr double kFloatRounding = 1e-6;

/// Probability of any false alarm in all tests of two equal images.
inline constexpr double kBiasLevel = 1e-3;

/// Squares over an image, row by row: of 8 x 8 pixels, or larger, so that there are at
/// most about 1024. Squares at the right and bottom may be cut.
struct TileLayout {
  int side = 0, columns = 0, rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y / side) * columns + x / side;
  }
};

TileLayout LayoutOf(int width, int height);

/// Returns the factor of path reuse on the variance of a mean of pixels: the sum of the
/// correlations of their errors. `squares`: the sum of squared correlations
/// (SampleGroups::dependents). Assumes equal correlations within a block.
double DependenceFactor(double squares);

/// Returns the mean variance of 5 x 5 tiles around one, with its degrees of freedom
/// (Welch and Satterthwaite). Rare samples that this tile missed are in its neighbours.
stat::MeanEstimate VarianceAround(const TileLayout& layout,
                                  const std::vector<stat::MeanEstimate>& tiles,
                                  std::size_t tile);

/// Returns whether the mean of a tile rests on enough samples. An image may miss all rare
/// bright samples, which its own variance does not show. (mean / standard error)^2 is the
/// number of equal samples with that variance. The larger variance counts; that of
/// `other` has `other_per_own` times as many samples.
bool HasEnoughObservations(const stat::MeanEstimate& own, const stat::MeanEstimate& other,
                           double other_per_own);

/// Returns the z-score with the two-sided p-value `p`, at most 9; negative if a < b.
double SignedZ(double p, const stat::MeanEstimate& a, const stat::MeanEstimate& b);

/// Writes "side", "columns", "rows", and "z" in rows; null for NaN.
nlohmann::json TilesJson(const TileLayout& layout, const std::vector<double>& z);

}  // namespace lanelight
