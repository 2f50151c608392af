// Fresnel reflectance and the GGX microfacet distribution, in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "src/base/core/vec.h"
#include "tests/reference/random.h"

namespace lanelight::reference {

/// Below this GGX alpha (both axes) an interface is treated as perfectly smooth, as pbrt
/// does; rough alphas are at least 1e-4.
inline constexpr double kSmoothAlpha = 1e-3;

/// Refracted cosine by Snell's law, sin_i = eta sin_t, for cos_i in [0, 1] and relative
/// index eta = n_transmitted / n_incident; -1 on total internal reflection.
inline double RefractedCosine(double cos_i, double eta) {
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  return sin2_t >= 1 ? -1 : std::sqrt(1 - sin2_t);
}

/// Unpolarised reflectance of a dielectric: the mean of the squared amplitude ratios of
/// the two polarisations, r_s = (cos_i - eta cos_t) / (cos_i + eta cos_t) and
/// r_p = (eta cos_i - cos_t) / (eta cos_i + cos_t).
inline double FresnelDielectric(double cos_i, double eta) {
  const double cos_t = RefractedCosine(cos_i, eta);
  if (cos_t < 0) return 1;
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return (s * s + p * p) / 2;
}

/// The same with the complex index eta + i k of a metal.
inline double FresnelConductor(double cos_i, double eta, double k) {
  using Complex = std::complex<double>;
  const Complex index(eta, k);
  const Complex cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (index * index));
  const Complex s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
  const Complex p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
  return (std::norm(s) + std::norm(p)) / 2;
}
inline Rgb FresnelConductor(double cos_i, Rgb eta, Rgb k) {
  return {FresnelConductor(cos_i, eta.x, k.x), FresnelConductor(cos_i, eta.y, k.y),
          FresnelConductor(cos_i, eta.z, k.z)};
}

/// GGX (Trowbridge and Reitz 1975; Walter et al. 2007): the surface is a height field
/// whose slopes (p, q) have the density 1 / (pi ax ay (1 + p^2/ax^2 + q^2/ay^2)^2).
struct Ggx {
  double ax = 0, ay = 0;

  bool smooth() const { return std::max(ax, ay) < kSmoothAlpha; }

  /// Density of normals per solid angle and macroscopic area. From the slope density with
  /// dp dq = domega / cos^3 and the area factor 1 / cos: D = P22 / cos^4.
  double D(Vec3d m) const {
    if (m.z <= 0) return 0;
    const double p = m.x / (m.z * ax), q = m.y / (m.z * ay);
    const double e = 1 + p * p + q * q;
    return 1 / (std::numbers::pi * ax * ay * e * e * m.z * m.z * m.z * m.z);
  }

  /// Smith's auxiliary function: Lambda = (sqrt(1 + (alpha tan)^2) - 1) / 2.
  double Lambda(Vec3d w) const {
    const double a2 = (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + a2) - 1) / 2;
  }

  /// Height-correlated masking and shadowing (Heitz 2014, eq. 99).
  double G(Vec3d a, Vec3d b) const { return 1 / (1 + Lambda(a) + Lambda(b)); }

  /// A normal with density D(m) m.z: draw slopes. In the stretched plane the radius has
  /// P(r < R) = R^2 / (1 + R^2), so r = sqrt(u / (1 - u)).
  Vec3d SampleNormal(Random& random) const {
    const double u = random.Uniform();
    const double r = std::sqrt(u / (1 - u)),
                 phi = 2 * std::numbers::pi * random.Uniform();
    return Normalize(Vec3d{-ax * r * std::cos(phi), -ay * r * std::sin(phi), 1});
  }
};

inline Vec3d Reflect(Vec3d w, Vec3d m) { return 2 * Dot(w, m) * m - w; }

}  // namespace lanelight::reference
