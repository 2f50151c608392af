#include "src/base/image/upsampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lanelight {
namespace {

using Coefficients = std::array<double, 3>;

double SigmoidOf(double x) { return 0.5 + 0.5 * x / std::sqrt(1 + x * x); }

double Evaluate(const Coefficients& c, double nm) {
  const double t = (nm - kFirstNm) / (kLastNm - kFirstNm) * 2 - 1;
  return SigmoidOf((c[0] * t + c[1]) * t + c[2]);
}

Rgb ColorOf(const Coefficients& c) {
  return ColorUnderD65([&](double nm) { return Evaluate(c, nm); });
}

double SquaredError(Rgb a, Rgb b) { return Dot(a - b, a - b); }

// Solves the 3x3 system m x = b by Cramer's rule; rows of m are vectors.
Vec3d Solve(const std::array<Vec3d, 3>& m, Vec3d b) {
  const double det = Dot(m[0], Cross(m[1], m[2]));
  const Vec3d x =
      Cross(m[1], m[2]) * b.x + Cross(m[2], m[0]) * b.y + Cross(m[0], m[1]) * b.z;
  return x / det;
}

// Levenberg-Marquardt from `c`.
Coefficients FitCoefficients(Rgb target, Coefficients c) {
  double damping = 1e-3;
  Rgb color = ColorOf(c);
  for (int iteration = 0; iteration < 30 && SquaredError(color, target) > 1e-10;
       ++iteration) {
    std::array<Vec3d, 3> jacobian;  // jacobian[k] = d color / d c[k]
    for (std::size_t k = 0; k < 3; ++k) {
      Coefficients step = c;
      step[k] += 1e-4;
      jacobian[k] = (ColorOf(step) - color) / 1e-4;
    }
    std::array<Vec3d, 3> normal;
    Vec3d gradient;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        normal[i][j] = Dot(jacobian[i], jacobian[j]) + (i == j ? damping : 0);
      }
      gradient[i] = Dot(jacobian[i], target - color);
    }
    const Vec3d delta = Solve(normal, gradient);
    const Coefficients next = {c[0] + delta.x, c[1] + delta.y, c[2] + delta.z};
    const Rgb next_color = ColorOf(next);
    if (SquaredError(next_color, target) < SquaredError(color, target)) {
      c = next;
      color = next_color;
      damping = std::max(damping * 0.3, 1e-9);
    } else {
      damping *= 10;
      if (damping > 1e3) break;
    }
  }
  return c;
}

}  // namespace

Spectrum ReflectanceOfRgb(Rgb rgb) {
  if (rgb.x == rgb.y && rgb.y == rgb.z) {
    return [value = rgb.x](double) { return value; };
  }
  // Steps from grey towards the colour: near the gamut's edge a direct fit gets stuck on
  // the flat parts of the sigmoid.
  const Rgb grey = {0.5, 0.5, 0.5};
  Coefficients c = {0, 0, 0};
  for (double fraction : {0.25, 0.5, 0.75, 0.9, 1.0})
    c = FitCoefficients(grey + (rgb - grey) * fraction, c);
  return [c](double nm) { return Evaluate(c, nm); };
}

}  // namespace lanelight
