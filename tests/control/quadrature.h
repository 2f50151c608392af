// Irradiance from lights of radiance 1 by quadrature in double, with the receiver at the
// origin: written from the definition, the integral of the cosine over the light's solid
// angle, with breaks where the horizon of the receiver cuts the light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "src/core/vec.h"

namespace lanelight::quadrature {

struct Rule {
  static constexpr int kNodes = 12;
  std::array<double, kNodes> x, w;  // Gauss-Legendre on [0, 1]
  Rule() {
    for (int i = 0; i < kNodes; ++i) {
      double z = std::cos(std::numbers::pi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
      for (int step = 0; step < 50; ++step) {
        double p0 = 1, p1 = z;
        for (int k = 2; k <= kNodes; ++k) {
          const double p2 = ((2 * k - 1) * z * p1 - (k - 1) * p0) / k;
          p0 = p1;
          p1 = p2;
        }
        slope = kNodes * (z * p1 - p0) / (z * z - 1);
        z -= p1 / slope;
      }
      x[static_cast<std::size_t>(i)] = (1 + z) / 2;
      w[static_cast<std::size_t>(i)] = 1 / ((1 - z * z) * slope * slope);
    }
  }
};

/// Integral of f over [a, b] in `panels` equal parts.
template <class F>
double Integrate(double a, double b, int panels, F&& f) {
  static const Rule rule;
  double sum = 0;
  const double h = (b - a) / panels;
  for (int i = 0; i < panels; ++i) {
    for (std::size_t k = 0; k < Rule::kNodes; ++k) {
      sum += rule.w[k] * f(a + h * (i + rule.x[k]));
    }
  }
  return sum * h;
}

/// Where a + t b crosses zero, if inside (0, 1).
inline void AddBreak(double a, double b, std::vector<double>& breaks) {
  if ((a > 0) == (a + b > 0)) return;
  breaks.push_back(-a / b);
}

/// Triangle of corners c relative to the receiver.
inline double Triangle(const Vec3d (&c)[3], Vec3d n) {
  const Vec3d e1 = c[1] - c[0], e2 = c[2] - c[0], normal = Cross(e1, e2);
  const double z0 = Dot(n, c[0]), z1 = Dot(n, e1), z2 = Dot(n, e2);
  std::vector<double> breaks = {0, 1};
  AddBreak(z0, z1, breaks);            // along the side t = 0
  AddBreak(z0 + z2, z1 - z2, breaks);  // along the side t = 1 - s
  std::sort(breaks.begin(), breaks.end());
  const auto strip = [&](double s) {
    double low = 0, high = 1 - s;
    const double at0 = z0 + s * z1, at1 = at0 + high * z2;
    if (at0 <= 0 && at1 <= 0) return 0.0;
    if (at0 < 0) low = -at0 / z2;
    if (at1 < 0) high = -at0 / z2;
    return Integrate(low, high, 6, [&](double t) {
      const Vec3d q = c[0] + s * e1 + t * e2;
      const double d2 = Dot(q, q);
      return std::abs(Dot(normal, q)) * Dot(n, q) / (d2 * d2);
    });
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    sum += Integrate(breaks[i], breaks[i + 1], 6, strip);
  }
  return sum;
}

/// Sphere seen from outside: rings of the cone of directions around its centre, of which
/// the part above the horizon is an arc.
inline double Sphere(Vec3d center, double radius, Vec3d n) {
  const double d = Length(center), half = std::asin(radius / d);
  const double cosine = Dot(n, center) / d, sine = Length(Cross(n, center)) / d;
  const double elevation = std::atan2(cosine, sine);
  const auto ring = [&](double theta) {
    const double a = std::cos(theta) * cosine, b = std::sin(theta) * sine;
    if (a <= -b) return 0.0;
    if (a >= b) return 2 * std::numbers::pi * a * std::sin(theta);
    const double phi = std::acos(-a / b);
    return 2 * (a * phi + b * std::sin(phi)) * std::sin(theta);
  };
  const double cut = std::min(half, std::abs(elevation));
  return Integrate(0, cut, 40, ring) + Integrate(cut, half, 40, ring);
}

/// Ring between two radii, wholly above the horizon.
inline double Disk(Vec3d center, Vec3d axis, double inner, double outer, Vec3d n) {
  const Vec3d u =
      Normalize(Cross(axis, std::abs(axis.x) > 0.5 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d v = Cross(axis, u);
  constexpr int kAngles = 256;  // the rule of equal steps is spectral on a circle
  return Integrate(inner, outer, 8, [&](double r) {
    double sum = 0;
    for (int i = 0; i < kAngles; ++i) {
      const double phi = 2 * std::numbers::pi * i / kAngles;
      const Vec3d q = center + r * std::cos(phi) * u + r * std::sin(phi) * v;
      const double d2 = Dot(q, q);
      sum += std::abs(Dot(axis, q)) * Dot(n, q) / (d2 * d2);
    }
    return sum * r * 2 * std::numbers::pi / kAngles;
  });
}

}  // namespace lanelight::quadrature
