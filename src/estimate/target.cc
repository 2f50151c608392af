#include "src/estimate/target.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lanelight {
namespace {

// The part of the target that the upper end of the error is, in terms of its square.
double Excess(const ErrorTarget& target, const ErrorEstimate& estimate) {
  double excess = 0;
  // Without an upper end the excess is infinite.
  if (target.relmse > 0) excess = estimate.relmse.high / target.relmse;
  if (target.rmse > 0) {
    excess = std::max(excess, std::pow(estimate.rmse.high / target.rmse, 2));
  }
  return excess;
}

}  // namespace

bool Reached(const ErrorTarget& target, const ErrorEstimate& estimate) {
  return estimate.available && Excess(target, estimate) < 1;
}

double SamplesNeeded(const ErrorTarget& target, const ErrorEstimate& estimate,
                     std::uint64_t done) {
  if (!estimate.available) return std::numeric_limits<double>::infinity();
  const double excess = Excess(target, estimate), now = static_cast<double>(done);
  return Reached(target, estimate) ? now * excess : std::max(now * excess, now + 1);
}

}  // namespace lanelight
