// What a film knows of a control variate whose coefficients are fitted to its samples:
// f - sum_j c_j D_j, E[D_j] = 0. Coefficients come from one half of a pixel's samples and
// correct the other, and the reverse: halves are independent of each other, so that
// E[c D] = E[c] E[D] = 0. Between them alternate units of samples, or replicates
// (src/path/replicates.h).
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/column.h"
#include "src/core/vec.h"
#include "src/image/replicate_sums.h"

namespace lanelight {

/// What control variates achieved over an image.
struct ControlReport {
  double coefficient = 0;  // mean; the paper's equation 7 has the opposite sign
  double correlation = 0;  // of f and D, over the variance of all pixels and channels
};

/// What the film knows of a pixel's f: the other half of what a fit needs.
struct ControlledColors {
  const std::vector<std::uint64_t>& samples;
  const std::vector<ReplicateSums>& replicates;  // empty without replicates
};

/// Consecutive samples of one pixel, plane by plane.
struct ControlledSamples {
  std::uint64_t first = 0;  // number of the first one
  std::uint32_t count = 0;
  const float* const* colors = nullptr;
  const float* const* planes = nullptr;  // of the control variate
};

/// Sums of one film, by pixel index y * width + x.
class FilmControl {
 public:
  virtual ~FilmControl() = default;

  /// Adds a pixel's samples, in order. Safe for different pixels from different threads.
  virtual void Add(std::size_t pixel, const ControlledSamples& samples) = 0;

  /// Fits the coefficients to all samples so far; before, they are 0.
  virtual void Fit(const ControlledColors& colors) = 0;

  /// To subtract from the sum of f over all samples, of which there are `samples`.
  virtual Rgb Correction(std::size_t pixel, std::uint64_t samples) const = 0;
  /// The same from the sums of its replicates.
  virtual void CorrectReplicates(std::size_t pixel, ReplicateSums& sums) const = 0;
  /// Scatter of the corrected units about their mean: sum of squares. Without replicates.
  virtual Rgb ResidualSquares(std::size_t pixel, std::uint64_t samples) const = 0;
  virtual ControlReport Report(const ControlledColors& colors) const = 0;

  /// All that has been added; coefficients are not part of it.
  virtual std::vector<MutableStateColumn> Columns() = 0;
};

}  // namespace lanelight
