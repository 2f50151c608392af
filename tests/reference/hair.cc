// Hair (Chiang et al. 2016), lobe by lobe as in the paper, with the Bessel function of
// the standard library.
#include <cmath>

#include "src/base/core/pi.h"
#include "tests/reference/bsdf.h"

namespace lanelight::reference {
namespace {

// Equation 5 of the paper; for narrow lobes by the leading terms of I0 for large numbers.
double AlongHair(double theta_i, double theta_o, double v) {
  const double a = std::cos(theta_i) * std::cos(theta_o) / v;
  const double b = std::sin(theta_i) * std::sin(theta_o) / v;
  const double log_bessel = a < 300 ? std::log(std::cyl_bessel_i(0.0, a))
                                    : a - std::log(2 * kPi * a) / 2 + 1 / (8 * a);
  const double log_norm = 1 / v + std::log(v) + std::log1p(-std::exp(-2 / v));
  return std::exp(log_bessel - b - log_norm);
}

double Logistic(double x, double s) {
  return 1 / (4 * s * std::pow(std::cosh(x / (2 * s)), 2));
}
double LogisticBelow(double x, double s) { return 1 / (1 + std::exp(-x / s)); }

double AroundHair(double phi, double s) {
  phi = std::remainder(phi, 2 * kPi);
  return Logistic(phi, s) / (LogisticBelow(kPi, s) - LogisticBelow(-kPi, s));
}

}  // namespace

Rgb EvaluateHairCos(const LocalMaterial& m, Vec3d wo, Vec3d wi) {
  const double theta_o = std::asin(wo.x), theta_i = std::asin(wi.x);
  const double phi = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y);
  const double gamma_o = std::asin(m.h);
  const double sin_t = std::sin(theta_o) / m.index;
  const double index = std::sqrt(m.index * m.index - wo.x * wo.x) / std::cos(theta_o);
  const double gamma_t = std::asin(m.h / index);
  const double length = 2 * std::cos(gamma_t) / std::sqrt(1 - sin_t * sin_t);
  const double f = FresnelDielectric(std::cos(theta_o) * std::cos(gamma_o), m.index);
  const double bm = m.beta_m, bn = m.beta_n;
  const double v0 = std::pow(0.726 * bm + 0.812 * bm * bm + 3.7 * std::pow(bm, 20), 2);
  const double s =
      std::sqrt(kPi / 8) * (0.265 * bn + 1.194 * bn * bn + 5.372 * std::pow(bn, 22));
  const double variance[] = {v0, v0 / 4, 4 * v0, 4 * v0};
  const double tilts[] = {-2, 1, 4, 0};
  Rgb sum;
  for (int c = 0; c < 3; ++c) {
    const double t = std::exp(-m.sigma_a[c] * length);
    const double light[] = {f, (1 - f) * (1 - f) * t, (1 - f) * (1 - f) * t * t * f,
                            (1 - f) * (1 - f) * t * t * t * f * f / (1 - t * f)};
    for (int p = 0; p < 4; ++p) {
      // Beyond a quarter turn the incline comes back on the other side.
      const double tilted = std::asin(std::sin(theta_o + tilts[p] * m.tilt));
      const double turn = 2 * p * gamma_t - 2 * gamma_o + p * kPi;
      const double around = p == 3 ? 1 / (2 * kPi) : AroundHair(phi - turn, s);
      sum[c] += light[p] * AlongHair(theta_i, tilted, variance[p]) * around;
    }
  }
  return sum;
}

}  // namespace lanelight::reference
