#include "src/stat/distributions.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/check.h"

namespace lanelight::stat {
namespace {

namespace bm = boost::math;

// Quantiles may be infinite, or too small for a double: no errors.
using Policy =
    bm::policies::policy<bm::policies::overflow_error<bm::policies::ignore_error>,
                         bm::policies::underflow_error<bm::policies::ignore_error>>;
constexpr Policy kPolicy;

}  // namespace

double GammaP(double a, double x) {
  LL_CHECK(a > 0 && x >= 0);
  return bm::gamma_p(a, x, kPolicy);
}

double GammaQ(double a, double x) {
  LL_CHECK(a > 0 && x >= 0);
  return bm::gamma_q(a, x, kPolicy);
}

double BetaI(double a, double b, double x) { return BetaI(a, b, x, 1 - x); }

double BetaI(double a, double b, double x, double y) {
  LL_CHECK(a > 0 && b > 0 && x >= 0 && x <= 1);
  return x < y ? bm::ibeta(a, b, x, kPolicy) : bm::ibetac(b, a, y, kPolicy);
}

double NormalCdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

double NormalQuantile(double p) {
  LL_CHECK(p > 0 && p < 1);
  return -std::numbers::sqrt2 * bm::erfc_inv(2 * p, kPolicy);
}

double StudentTwoSided(double t, double nu) {
  LL_CHECK(nu > 0);
  if (std::isinf(t)) return 0;
  if (std::isinf(nu)) return 2 * NormalCdf(-std::abs(t));
  // With x = nu / (nu + t^2): I_x(nu/2, 1/2).
  const double t2 = t * t;
  return BetaI(nu / 2, 0.5, nu / (nu + t2), t2 / (nu + t2));
}

double StudentCdf(double t, double nu) {
  const double tail = StudentTwoSided(t, nu) / 2;
  return t > 0 ? 1 - tail : tail;
}

double StudentTwoSidedQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p <= 1 && nu > 0);
  if (std::isinf(nu)) return -NormalQuantile(p / 2);
  double y;
  const double x = bm::ibeta_inv(nu / 2, 0.5, p, &y, kPolicy);
  return std::sqrt(nu * (y / x));
}

double ChiSquareSurvival(double x, double nu) {
  return x <= 0 ? 1 : GammaQ(nu / 2, x / 2);
}

double ChiSquareQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p < 1 && nu > 0);
  // The smaller of the two tails is the one known to full relative precision.
  return 2 * (p < 0.5 ? bm::gamma_p_inv(nu / 2, p, kPolicy)
                      : bm::gamma_q_inv(nu / 2, 1 - p, kPolicy));
}

double FQuantile(double p, double d1, double d2) {
  LL_CHECK(p > 0 && p < 1 && d1 > 0 && d2 > 0);
  double y;
  const double x = p < 0.5 ? bm::ibeta_inv(d1 / 2, d2 / 2, p, &y, kPolicy)
                           : bm::ibetac_inv(d1 / 2, d2 / 2, 1 - p, &y, kPolicy);
  return y > 0 ? x / y * (d2 / d1) : std::numeric_limits<double>::infinity();
}

double KolmogorovSurvival(double d, int n) {
  LL_CHECK_GE(n, 1);
  const double root = std::sqrt(static_cast<double>(n));
  const double lambda = (root + 0.12 + 0.11 / root) * d;
  if (lambda < 0.2) return 1;  // the survival differs from 1 by less than 1e-12
  double sum = 0;
  for (int k = 1; k <= 100; ++k) {
    const double term = std::exp(-2.0 * k * k * lambda * lambda);
    sum += k % 2 == 1 ? term : -term;
    if (term < 1e-17) break;
  }
  return std::min(1.0, std::max(0.0, 2 * sum));
}

}  // namespace lanelight::stat
