// Distribution functions for hypothesis tests, by Boost.Math, in double precision. Stated
// errors are checked by tests/base/stat/distributions_test.cc.
#pragma once

namespace lanelight::stat {

/// Regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1. Relative error
/// below 1e-11 for a, b <= 1e4.
double BetaI(double a, double b, double x);
/// The same for x close to 1, where `y` = 1 - x is known without cancellation.
double BetaI(double a, double b, double x, double y);

/// P(Z <= z) of the standard normal, and its inverse for 0 < p < 1 (relative error 1e-13;
/// both tails).
double NormalCdf(double z);
double NormalQuantile(double p);

/// P(|T| >= |t|) of Student's t with nu > 0 degrees of freedom (need not be whole, may be
/// infinite).
double StudentTwoSided(double t, double nu);
/// The t >= 0 with StudentTwoSided(t, nu) = p, 0 < p <= 1 (relative error 1e-10).
double StudentTwoSidedQuantile(double p, double nu);

/// The f with P(F <= f) = p of Snedecor's F with d1 and d2 degrees of freedom, 0.1 to 1e9
/// each, 0 < p < 1. Relative error 1e-9 up to 1e4 degrees, 1e-7 beyond. Infinite or 0
/// where f leaves the range of double.
double FQuantile(double p, double d1, double d2);

}  // namespace lanelight::stat
