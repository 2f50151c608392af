// Hypothesis tests on means and p-values, and intervals that hold at every look.
#pragma once

#include <cstddef>
#include <span>
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

/// How many standard errors either side of an estimate has, so that the intervals hold at
/// all looks from the first one on together, with probability `confidence`. `growth` >=
/// 1: the data over that of the first look, in intrinsic time (the variance of the
/// martingale that the estimate is made of). Grows as the root of the logarithm of
/// `growth`.
///
/// Robbins' normal mixture (1970, "Statistical methods related to the law of the iterated
/// logarithm", Annals of Mathematical Statistics 41), with the variance of the mixture at
/// the first look. For sums that are normal only in the limit it is an asymptotic
/// confidence sequence. Source: Waudby-Smith, Arbour, Sinha, Kennedy and Ramdas 2024,
/// "Time-uniform central limit theory and asymptotic confidence sequences", Annals of
/// Statistics 52.
double TimeUniformQuantile(double growth, double confidence);

/// Holm's (1979) step-down procedure: which hypotheses are rejected, as ascending
/// indices. Any false rejection happens with probability at most `family` in (0, 1),
/// however the tests depend on each other. A p-value of NaN is never rejected.
std::vector<std::size_t> HolmRejections(std::span<const double> p, double family);

/// Mean of independent measurements of one quantity, weighted by inverse variances. If
/// their chi-square shows that they vary more than their variances explain, the variance
/// of the mean is multiplied by Birge's (1932) ratio, chi-square over its degrees of
/// freedom. Variances below `min_variance` count as `min_variance` > 0.
struct Consensus {
  MeanEstimate estimate;
  double birge = 1;  // at least 1
};
Consensus ConsensusOf(std::span<const MeanEstimate> measurements, double min_variance);

/// p-value of the test that `one` measures what the `others` measure (Welch's test
/// against their consensus, both variances multiplied by their Birge ratio): large where
/// they do not agree among themselves. 1 without others.
double DeparturePValue(const MeanEstimate& one, std::span<const MeanEstimate> others,
                       double min_variance);

}  // namespace lanelight::stat
