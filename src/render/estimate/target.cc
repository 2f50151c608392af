#include "src/render/estimate/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanelight {
namespace {

// Returns these errors relative to the target, squared.
double Part(const ErrorTarget& target, double relmse, double rmse) {
  double part = 0;
  if (target.relmse > 0) part = relmse / target.relmse;
  if (target.rmse > 0) part = std::max(part, std::pow(rmse / target.rmse, 2));
  return part;
}

// Returns the Part of the upper ends; infinite without one.
double Excess(const ErrorTarget& target, const ErrorEstimate& estimate) {
  return Part(target, estimate.relmse.high, estimate.rmse.high);
}

}  // namespace

bool Reached(const ErrorTarget& target, const ErrorEstimate& estimate) {
  return estimate.available && Excess(target, estimate) < 1;
}

bool IsHopeless(const ErrorTarget& target, const ErrorEstimate& estimate) {
  return estimate.available && !std::isfinite(Excess(target, estimate)) &&
         kHopelessFactor * Part(target, estimate.relmse.value, estimate.rmse.value) < 1;
}

double SamplesNeeded(const ErrorTarget& target, const ErrorEstimate& estimate,
                     std::uint64_t done) {
  if (!estimate.available) return std::numeric_limits<double>::infinity();
  if (IsHopeless(target, estimate)) return -1;
  const double excess = Excess(target, estimate), now = double(done);
  return Reached(target, estimate) ? now * excess : std::max(now * excess, now + 1);
}

}  // namespace lanelight
