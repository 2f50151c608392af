// The scalar twin of procedural textures: noise as a sum over the corners of a cell,
// splines by Bernstein polynomials, angles by arc functions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/texture/noise_table.h"
#include "src/base/core/vec.h"

namespace lanelight::reference {

/// Gradient of a lattice point: which of 16 vectors, by a hash.
inline Vec3d NoiseGradient(int i, int j, int k) {
  static constexpr std::array<std::array<int, 3>, 16> kGradients = {{{1, 1, 0},
                                                                     {-1, 1, 0},
                                                                     {1, -1, 0},
                                                                     {-1, -1, 0},
                                                                     {1, 0, 1},
                                                                     {-1, 0, 1},
                                                                     {1, 0, -1},
                                                                     {-1, 0, -1},
                                                                     {0, 1, 1},
                                                                     {0, -1, 1},
                                                                     {0, 1, -1},
                                                                     {0, -1, -1},
                                                                     {1, 1, 0},
                                                                     {-1, 1, 0},
                                                                     {0, 1, -1},
                                                                     {0, -1, -1}}};
  const auto p = [](int n) { return kNoisePermutation[n & 255]; };
  const auto& g = kGradients[p(p(p(i) + j) + k) & 15];
  return {double(g[0]), double(g[1]), double(g[2])};
}

inline double Noise(Vec3d p) {
  const auto blend = [](double t) { return std::pow(t, 3) * (10 + t * (-15 + t * 6)); };
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = std::floor(p.x) + (corner & 1);
    const double y = std::floor(p.y) + (corner >> 1 & 1);
    const double z = std::floor(p.z) + (corner >> 2);
    const Vec3d from = {p.x - x, p.y - y, p.z - z};
    const double weight = blend(1 - std::abs(from.x)) * blend(1 - std::abs(from.y)) *
                          blend(1 - std::abs(from.z));
    const auto cell = [](double c) { return static_cast<int>(std::fmod(c, 65536)); };
    sum += weight * Dot(NoiseGradient(cell(x), cell(y), cell(z)), from);
  }
  return sum;
}

/// Sum of roughness^i f(noise of 1.99^i p).
template <class F>
double Octaves(Vec3d p, int octaves, double roughness, const F& f) {
  double sum = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += std::pow(roughness, i) * f(Noise(std::pow(1.99, i) * p));
  }
  return sum;
}

inline double Fbm(Vec3d p, int octaves, double roughness) {
  return Octaves(p, octaves, roughness, [](double n) { return n; });
}

/// pbrt adds 0.2 for the octave that follows.
inline double Wrinkled(Vec3d p, int octaves, double roughness) {
  return Octaves(p, octaves, roughness, [](double n) { return std::abs(n); }) +
         0.2 * std::pow(roughness, octaves);
}

inline double Windy(Vec3d p) { return std::abs(Fbm(0.1 * p, 3, 0.5)) * Fbm(p, 6, 0.5); }

inline Rgb MarbleColor(Vec3d p, int octaves, double roughness, double variation) {
  static constexpr double kBlue[9] = {.6, .6, .6, .5, .58, .6, .6, .33, .6};
  static constexpr double kGreen[9] = {.58, .58, .58, .5, .59, .58, .58, .2, .58};
  static constexpr double kRed[9] = {.58, .58, .58, .5, .6, .58, .58, .2, .58};
  const double phase = p.y + variation * Fbm(p, octaves, roughness);
  const double x = 6 * (1 + std::sin(phase)) / 2;
  const int i = std::min(static_cast<int>(x), 5);
  const double t = x - i, s = 1 - t;
  const auto curve = [&](const double* c) {
    return 1.5 * (s * s * s * c[i] + 3 * s * s * t * c[i + 1] + 3 * s * t * t * c[i + 2] +
                  t * t * t * c[i + 3]);
  };
  return {curve(kRed), curve(kGreen), curve(kBlue)};
}

/// Returns whether (s, t) lies in one of the dots: one of radius 0.35 around a shifted
/// centre in every cell whose noise is positive.
inline bool IsInDot(double s, double t) {
  const double i = std::round(s), j = std::round(t);
  if (Noise({i + 0.5, j + 0.5, 0.5}) <= 0) return false;
  const double ci = i + 0.15 * Noise({i + 1.5, j + 2.8, 0.5});
  const double cj = j + 0.15 * Noise({i + 4.5, j + 9.8, 0.5});
  return std::hypot(s - ci, t - cj) < 0.35;
}

}  // namespace lanelight::reference
