#include "src/stat/distributions.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/check.h"

namespace lanelight::stat {
namespace {

constexpr double kTiny = 1e-300;
constexpr double kEpsilon = 1e-16;
constexpr int kMaxTerms = 100000;

// Continued fraction b0 + a1/(b1 + a2/(b2 + ...)) by the modified Lentz method;
// term(i, a, b) sets a_i and b_i.
template <typename Term>
double Lentz(double b0, Term term) {
  double f = b0 == 0 ? kTiny : b0, c = f, d = 0;
  for (int i = 1; i < kMaxTerms; ++i) {
    double a, b;
    term(i, a, b);
    d = b + a * d;
    c = b + a / c;
    if (d == 0) d = kTiny;
    if (c == 0) c = kTiny;
    d = 1 / d;
    f *= c * d;
    if (std::abs(c * d - 1) < kEpsilon) break;
  }
  return f;
}

// x^a e^-x / Gamma(a). For large a the three huge logarithms cancel; Stirling's series
// for log Gamma(a) takes the cancellation out: with x = a (1 + d) what remains is
// a (log1p(d) - d).
double GammaPrefix(double a, double x) {
  if (a < 100) return std::exp(a * std::log(x) - x - std::lgamma(a));
  const double d = (x - a) / a;
  const double a2 = a * a;
  const double stirling = 1 / (12 * a) - 1 / (360 * a * a2) + 1 / (1260 * a2 * a2 * a);
  return std::sqrt(a / (2 * std::numbers::pi)) *
         std::exp(a * (std::log1p(d) - d) - stirling);
}

double GammaSeries(double a, double x) {
  double term = 1 / a, sum = term;
  for (int i = 1; i < kMaxTerms && term > sum * kEpsilon; ++i) {
    term *= x / (a + i);
    sum += term;
  }
  return GammaPrefix(a, x) * sum;
}

double GammaFraction(double a, double x) {
  const double f = Lentz(x + 1 - a, [&](int i, double& num, double& den) {
    num = -i * (i - a);
    den = x + 2 * i + 1 - a;
  });
  return GammaPrefix(a, x) / f;
}

}  // namespace

double GammaP(double a, double x) {
  LL_CHECK(a > 0 && x >= 0);
  if (x == 0) return 0;
  return x < a + 1 ? GammaSeries(a, x) : 1 - GammaFraction(a, x);
}

double GammaQ(double a, double x) {
  LL_CHECK(a > 0 && x >= 0);
  if (x == 0) return 1;
  return x < a + 1 ? 1 - GammaSeries(a, x) : GammaFraction(a, x);
}

double BetaI(double a, double b, double x) {
  LL_CHECK(a > 0 && b > 0 && x >= 0 && x <= 1);
  if (x == 0 || x == 1) return x;
  // The fraction converges fast below the mean; above it, use the symmetry.
  if (x > (a + 1) / (a + b + 2)) return 1 - BetaI(b, a, 1 - x);
  const double f = Lentz(1, [&](int i, double& num, double& den) {
    const double m = i / 2;
    den = 1;
    num = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                     : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
  });
  const double prefix = std::exp(a * std::log(x) + b * std::log1p(-x) +
                                 std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b));
  return prefix / (a * f);
}

double NormalCdf(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

double NormalQuantile(double p) {
  LL_CHECK(p > 0 && p < 1);
  if (p > 0.5) return -NormalQuantile(1 - p);
  // Newton's method on log(cdf), which is concave and nearly quadratic in the lower tail,
  // from a point below the root: monotone convergence.
  double z = -std::sqrt(-2 * std::log(p)) - 1e-3;
  for (int i = 0; i < 60; ++i) {
    const double cdf = NormalCdf(z);
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    const double step = std::log(cdf / p) * cdf / density;
    z -= step;
    if (std::abs(step) <= 1e-15 * std::abs(z)) break;
  }
  return z;
}

double StudentTwoSided(double t, double nu) {
  LL_CHECK(nu > 0);
  if (std::isinf(t)) return 0;
  if (nu > 1e5) {  // the logarithms of BetaI would cancel
    return 2 *
           NormalCdf(-std::abs(t) * (1 - 1 / (4 * nu)) / std::sqrt(1 + t * t / (2 * nu)));
  }
  // With x = nu / (nu + t^2): I_x(nu/2, 1/2). Written with 1 - x where t is small.
  const double t2 = t * t;
  if (t2 < nu) return 1 - BetaI(0.5, nu / 2, t2 / (nu + t2));
  return BetaI(nu / 2, 0.5, nu / (nu + t2));
}

double StudentCdf(double t, double nu) {
  const double tail = StudentTwoSided(t, nu) / 2;
  return t > 0 ? 1 - tail : tail;
}

double StudentTwoSidedQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p <= 1);
  double low = 0, high = 1;
  while (StudentTwoSided(high, nu) > p) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
    const double middle = (low + high) / 2;
    (StudentTwoSided(middle, nu) > p ? low : high) = middle;
  }
  return (low + high) / 2;
}

double ChiSquareSurvival(double x, double nu) {
  return x <= 0 ? 1 : GammaQ(nu / 2, x / 2);
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
