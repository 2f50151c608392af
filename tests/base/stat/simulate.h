// Simulated repetitions for tests of statistics: how often does an interval hold?
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "src/base/stat/efficiency.h"
#include "tests/reference/random.h"

namespace lanelight::stat {

/// A standard normal number (Box and Muller 1958).
inline double Normal(reference::Random& random) {
  const double radius = std::sqrt(-2 * std::log(random.Uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.Uniform());
}

/// Log-normal of mean 1 from a standard normal number.
inline double LogNormal(double z, double sigma) {
  return std::exp(sigma * z - sigma * sigma / 2);
}

/// Mean of `degrees` squared standard normal numbers: mean 1, variance 2 / degrees. What
/// the mean squared error of an image of so many pixels is like.
inline double ChiSquareMean(reference::Random& random, int degrees) {
  double sum = 0;
  for (int i = 0; i < degrees; ++i) {
    const double z = Normal(random);
    sum += z * z;
  }
  return sum / degrees;
}

/// Share of `trials` for which `trial(random)` is true.
template <class Trial>
double Share(int trials, std::uint64_t seed, Trial trial) {
  reference::Random random(seed);
  int count = 0;
  for (int i = 0; i < trials; ++i) count += trial(random) ? 1 : 0;
  return static_cast<double>(count) / trials;
}

/// Five standard deviations of a share `p` of `trials` (false alarm about 6e-7).
inline double FiveSigma(double p, int trials) {
  return 5 * std::sqrt(p * (1 - p) / trials);
}

}  // namespace lanelight::stat
