// Which strategy gives the least error for the time: ratios of efficiency 1 / (error x
// seconds) with intervals, and a ranking that claims no more than these.
#pragma once

#include <span>
#include <vector>

#include "src/base/stat/interval.h"

namespace lanelight::stat {

/// One repetition of a render: its mean squared error and what it cost.
struct Cost {
  double error = 0, seconds = 0;
};

/// Efficiency of `other` relative to `baseline`, each 1 / (mean error x mean seconds).
/// Repetition i of both ran with the same seed, so pairs are kept together. The interval
/// of its logarithm is HalfWidth()'s (src/base/stat/bootstrap.h): Student's t with the
/// jackknife's standard error, widened by the studentised bootstrap (Efron and Tibshirani
/// 1993, "An Introduction to the Bootstrap", chapter 12) from 8 pairs on; deterministic.
/// Its coverage, by simulation (tests/base/stat/efficiency_test.cc): nominal for errors
/// that scatter by up to half their mean; where one strategy's errors are log-normal with
/// a standard deviation of 1.3 of their mean and the other's are steady, 88 % at a
/// confidence of 95 %. Without bounds for fewer than three pairs. A mean error of zero
/// (or below, where a reference's own error is subtracted) in either makes the ratio 0,
/// infinite, or, in both, that of the seconds; then without bounds. Seconds below 1e-9
/// count as 1e-9.
Interval EfficiencyRatio(std::span<const Cost> baseline, std::span<const Cost> other,
                         double confidence);

/// Ranks that a strategy may have: 1 is the most efficient. `best` = 1 + how many are
/// certainly better, `worst` = n - how many are certainly worse. Strategies whose ranges
/// overlap may still differ; equal ranges are not distinguishable.
struct RankRange {
  int best = 1, worst = 1;
};

/// The interval of a ratio whose logarithm has an independent error of this standard
/// deviation beside what the interval is about: half widths of the logarithm add as their
/// squares, that of the error by the normal distribution.
Interval Widened(const Interval& ratio, double deviation, double confidence);

/// Ranks of all strategies, each with the same number of repetitions. All pairwise claims
/// hold together with probability `confidence` (Sidak). Ranks are independent of order.
/// `uncertainties`: of each strategy, the standard deviation of an error of the logarithm
/// of its efficiency that all its repetitions share; empty: none.
std::vector<RankRange> RankByEfficiency(const std::vector<std::vector<Cost>>& strategies,
                                        double confidence,
                                        std::span<const double> uncertainties = {});

}  // namespace lanelight::stat
