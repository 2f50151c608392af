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

// What Stirling's series adds to (a - 1/2) log a - a + log(2 pi) / 2, a >= 10.
double StirlingTail(double a) {
  const double r = 1 / (a * a);
  return (1 / 12.0 - r * (1 / 360.0 - r * (1 / 1260.0 - r / 1680))) / a;
}

// x^a y^b / B(a, b), y = 1 - x. The logarithms of the gamma functions are huge beside
// what remains of them where a or b is large; Stirling's series takes that out.
double BetaPrefix(double a, double b, double x, double y) {
  constexpr double kLarge = 20;
  if (a > kLarge && b < a) return BetaPrefix(b, a, y, x);  // b is the larger, if large
  if (b <= kLarge) {
    return std::exp(a * std::log(x) + b * std::log(y) + std::lgamma(a + b) -
                    std::lgamma(a) - std::lgamma(b));
  }
  const double sum = a + b, log_y = y > 0.5 ? std::log1p(-x) : std::log(y);
  if (a <= kLarge) {
    // log(Gamma(a + b) / Gamma(b))
    const double ratio = a * std::log(sum) + (b - 0.5) * std::log1p(a / b) - a +
                         StirlingTail(sum) - StirlingTail(b);
    return std::exp(a * std::log(x) + b * log_y + ratio - std::lgamma(a));
  }
  // With x = a (1 + d) / (a + b), what remains of the powers is a (log1p(d) - d), and
  // the same for y: the two linear terms cancel.
  const double dx = (x * b - y * a) / a, dy = (y * a - x * b) / b;
  return std::sqrt(a * (b / sum) / (2 * std::numbers::pi)) *
         std::exp(a * (std::log1p(dx) - dx) + b * (std::log1p(dy) - dy) +
                  StirlingTail(sum) - StirlingTail(a) - StirlingTail(b));
}

// I_x(a, b) by its continued fraction, for x up to about the mean.
double BetaFraction(double a, double b, double x, double y) {
  const double f = Lentz(1, [&](int i, double& num, double& den) {
    const int half = i / 2;
    const double m = half;
    den = 1;
    num = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                     : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
  });
  return BetaPrefix(a, b, x, y) / (a * f);
}

// The u in [low, high] where the falling function `above` turns from true to false.
template <typename Above>
double Bisect(double low, double high, Above above) {
  for (int i = 0; i < 200 && high - low > 1e-13 * std::max(1e-3, std::abs(low)); ++i) {
    const double middle = low + (high - low) / 2;
    (above(middle) ? low : high) = middle;
  }
  return low + (high - low) / 2;
}

// Quantiles of positive variables are sought as logarithms, over nearly all of double.
constexpr double kLogRange = 700;

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

double BetaI(double a, double b, double x) { return BetaI(a, b, x, 1 - x); }

double BetaI(double a, double b, double x, double y) {
  LL_CHECK(a > 0 && b > 0 && x >= 0 && x <= 1);
  if (x == 0) return 0;
  if (y == 0) return 1;
  // The fraction converges fast below the mean; above it, use the symmetry.
  if (x > (a + 1) / (a + b + 2)) return 1 - BetaFraction(b, a, y, x);
  return BetaFraction(a, b, x, y);
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

double ChiSquareQuantile(double p, double nu) {
  LL_CHECK(p > 0 && p < 1 && nu > 0);
  if (nu > 1e4) {
    const double v = 2 / (9 * nu);
    const double root = 1 - v + NormalQuantile(p) * std::sqrt(v);
    return nu * root * root * root;
  }
  const double a = nu / 2;
  // The smaller of the two tails is the one known to full relative precision.
  return 2 * std::exp(Bisect(-kLogRange, std::log(a) + 10, [&](double u) {
           const double x = std::exp(u);
           return p < 0.5 ? GammaP(a, x) < p : GammaQ(a, x) > 1 - p;
         }));
}

double FQuantile(double p, double d1, double d2) {
  LL_CHECK(p > 0 && p < 1 && d1 > 0 && d2 > 0);
  // With u = log(d1 f / d2): x = 1 / (1 + e^-u), and 1 - x without cancellation.
  const double u = Bisect(-kLogRange, kLogRange, [&](double v) {
    const double x = 1 / (1 + std::exp(-v)), y = 1 / (1 + std::exp(v));
    return p < 0.5 ? BetaI(d1 / 2, d2 / 2, x, y) < p
                   : BetaI(d2 / 2, d1 / 2, y, x) > 1 - p;
  });
  if (std::abs(u) > kLogRange - 1) {
    return u < 0 ? 0 : std::numeric_limits<double>::infinity();
  }
  return std::exp(u) * (d2 / d1);
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
