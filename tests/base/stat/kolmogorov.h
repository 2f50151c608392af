// The test of Kolmogorov and Smirnov, for tests of what must be uniform.
#pragma once

#include <vector>

namespace lanelight::stat {

/// P(D_n >= d) of the two-sided statistic of n samples. Kolmogorov's series with
/// Stephens' (1970) correction sqrt(n) + 0.12 + 0.11 / sqrt(n): within 0.01 absolute for
/// n >= 10, and within 20 % relative down to 1e-4.
double KolmogorovSurvival(double d, int n);

/// p-value of the test that `values` are uniform on [0, 1].
double KsUniformPValue(std::vector<double> values);

}  // namespace lanelight::stat
