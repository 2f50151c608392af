// When an image is good enough: the stop rule of --target-relmse and --target-rmse.
#pragma once

#include <cstdint>

#include "src/render/estimate/estimate.h"

namespace lanelight {

/// Limits of the true error; 0 = none.
struct ErrorTarget {
  double relmse = 0, rmse = 0;
  bool Any() const { return relmse > 0 || rmse > 0; }
};

/// Returns whether the upper ends of the estimate's intervals are below the target.
bool Reached(const ErrorTarget& target, const ErrorEstimate& estimate);

/// The estimate refuses to name an upper end, and goes on doing so: kHopeless times as
/// many samples are taken as its value asks for. An image of fewer pixels than an
/// interval rests on (kLeastEffectivePixels) never gets one.
bool IsHopeless(const ErrorTarget& target, const ErrorEstimate& estimate);
inline constexpr double kHopeless = 64;

/// Samples per pixel that this is expected to take, of which `done` are taken: squared
/// errors fall like 1 / samples. At most `done` if it is reached, more if not; infinite
/// without an upper end; below 0 if there will be none (IsHopeless).
double SamplesNeeded(const ErrorTarget& target, const ErrorEstimate& estimate,
                     std::uint64_t done);

}  // namespace lanelight
