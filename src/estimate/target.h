// When an image is good enough: the stop rule of --target-relmse and --target-rmse.
#pragma once

#include <cstdint>

#include "src/estimate/estimate.h"

namespace lanelight {

/// Limits of the true error; 0 = none.
struct ErrorTarget {
  double relmse = 0, rmse = 0;
  bool Any() const { return relmse > 0 || rmse > 0; }
};

/// Whether the upper ends of the estimate's intervals are below the target.
bool Reached(const ErrorTarget& target, const ErrorEstimate& estimate);

/// Samples per pixel that this is expected to take, of which `done` are taken: squared
/// errors fall like 1 / samples. At most `done` if it is reached, more if not; infinite
/// without an estimate.
double SamplesNeeded(const ErrorTarget& target, const ErrorEstimate& estimate,
                     std::uint64_t done);

}  // namespace lanelight
