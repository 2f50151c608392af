#include "src/base/stat/distributions.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/core/check.h"

namespace lanelight::stat {
namespace {

namespace bm = boost::math;

// Quantiles may be infinite, or too small for a double: no errors.
using Policy =
    bm::policies::policy<bm::policies::overflow_error<bm::policies::ignore_error>,
                         bm::policies::underflow_error<bm::policies::ignore_error>>;
constexpr Policy kPolicy;

}  // namespace

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
  // I_x(nu/2, 1/2) at x = nu / (nu + t^2).
  const double t2 = t * t;
  return BetaI(nu / 2, 0.5, nu / (nu + t2), t2 / (nu + t2));
}

double StudentTwoSidedQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p <= 1 && nu > 0);
  if (std::isinf(nu)) return -NormalQuantile(p / 2);
  double y;
  const double x = bm::ibeta_inv(nu / 2, 0.5, p, &y, kPolicy);
  return std::sqrt(nu * (y / x));
}

double FQuantile(double p, double d1, double d2) {
  LL_CHECK(p > 0 && p < 1 && d1 > 0 && d2 > 0);
  double y;
  const double x = p < 0.5 ? bm::ibeta_inv(d1 / 2, d2 / 2, p, &y, kPolicy)
                           : bm::ibetac_inv(d1 / 2, d2 / 2, 1 - p, &y, kPolicy);
  return y > 0 ? x / y * (d2 / d1) : std::numeric_limits<double>::infinity();
}

}  // namespace lanelight::stat
