// Hypothesis tests on means and p-values.
#pragma once

#include <vector>

namespace lanelight::stat {

/// A sample mean with the estimated variance of that mean and the degrees of freedom of
/// the estimate (independent observations - 1). Known values: variance 0.
struct MeanEstimate {
  double mean = 0;
  double variance = 0;
  double dof = 0;
};

/// Mean of estimates; degrees of freedom by Welch and Satterthwaite. `as_one` >= 1: how
/// many times the variance of the mean is that of independent estimates (the sum of the
/// correlations of one with all others), at most their number.
MeanEstimate Average(const std::vector<MeanEstimate>& estimates, double as_one = 1);

/// Welch's t-test of equal means: two-sided p-value. `tolerance` >= 0: differences up to
/// it count as none (the test is then conservative). With both variances zero: 1 if the
/// difference is within the tolerance, else 0.
double WelchPValue(const MeanEstimate& a, const MeanEstimate& b, double tolerance = 0);

/// Sidak: per-test level so that n independent tests together raise a false alarm with
/// probability `family`. Conservative for positively dependent tests.
double SidakLevel(double family, int n);

}  // namespace lanelight::stat
