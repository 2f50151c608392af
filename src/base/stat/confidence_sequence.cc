#include "src/base/stat/confidence_sequence.h"

#include <cmath>

namespace lanelight::stat {

// A martingale M of variance V exceeds sqrt((V + r) log((V + r) / (r a^2))) at any time
// with probability a at most (Ville's inequality for the mixture); here r = 1, in units
// of the variance at the first look, and over the standard error sqrt(V).
double TimeUniformQuantile(double growth, double confidence) {
  const double alpha = 1 - confidence;
  return std::sqrt((1 + 1 / growth) * std::log((growth + 1) / (alpha * alpha)));
}

}  // namespace lanelight::stat
