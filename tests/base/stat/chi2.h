// Chi-square goodness of fit, for tests of sampling routines. Seeds are fixed and never
// tuned; a family of tests shares one false-alarm budget (SidakLevel).
#pragma once

#include <vector>

namespace lanelight::stat {

/// P(X >= x) of chi-square with nu degrees of freedom.
double ChiSquareSurvival(double x, double nu);
/// The x with P(X <= x) = p, 0 < p < 1, nu > 0.
double ChiSquareQuantile(double p, double nu);

struct ChiSquareResult {
  double statistic = 0;
  int degrees = 0;
  double p = 1;  // probability of a statistic at least as large under the hypothesis
};

/// Tests counts against expected counts of the same total. Cells expected to hold fewer
/// than 5 are pooled into one; if even that expects fewer than 5 it joins the smallest
/// other cell. A count in a pool that expects less than 1e-9 gives p = 0.
ChiSquareResult ChiSquareTest(const std::vector<double>& observed,
                              const std::vector<double>& expected);

}  // namespace lanelight::stat
