// How the cases of geometry put down axes and points.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/core/vec.h"
#include "src/stress/stress_case.h"

namespace lanelight::stress {

/// A unit normal along no axis.
inline const Vec3d kLeaning = Normalize(Vec3d{0.3, -0.5, 0.8});

/// 10^low to 10^high, every `step` decades; three values a decade with full effort.
/// Promised within [10^promised_low, 10^promised_high].
inline Axis Decades(std::string name, std::string unit, int low, int high, int step,
                    double promised_low, double promised_high) {
  Axis axis{std::move(name),
            std::move(unit),
            true,
            std::pow(10, promised_low) * 0.99,
            std::pow(10, promised_high) * 1.01,
            {},
            {}};
  for (int k = low; k <= high; k += step) axis.quick.push_back(std::pow(10.0, k));
  for (int k = 3 * low; k <= 3 * high; ++k) axis.full.push_back(std::pow(10.0, k / 3.0));
  return axis;
}

/// For Truth::kBound: the largest of errors against what it may be.
inline Point BoundPoint(double worst, double bound, std::string series = "") {
  Point point;
  point.series = std::move(series);
  point.measured = worst;
  point.expected = bound;
  return point;
}

/// For Truth::kRate: failures are promised not to happen more often than `rate`.
inline Point RatePoint(std::uint64_t failures, std::uint64_t trials, double rate = 0,
                       std::string series = "") {
  Point point;
  point.series = std::move(series);
  point.failures = failures;
  point.trials = trials;
  point.expected = rate;
  point.measured = trials == 0 ? 0 : double(failures) / double(trials);
  return point;
}

/// A square image of a scene, and what its mean must be.
struct SmallImage {
  std::string text;          // the scene
  double expected = 0;       // mean over pixels and channels
  double relative = 1e-5;    // tolerance, of `expected`
  int pixels = 8;            // in a row
  std::uint64_t quick = 64;  // samples per pixel ...
  std::uint64_t full = 4096;
  int depth = 5;
  std::string series = {};
};

/// Renders it.
Point Measure(const SmallImage& image, const Effort& effort);

/// Renders it twice: paths that find the sky by hitting it, where every sample of a
/// convex shape is its albedo exactly, and, with 16 times the samples, the usual ones
/// with shadow rays. Two series.
std::vector<Point> MeasureFurnace(SmallImage image, const Effort& effort);

/// A case that is not a map.
inline Axis Single() { return {}; }

}  // namespace lanelight::stress
