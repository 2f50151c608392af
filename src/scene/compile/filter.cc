#include "src/scene/compile/camera.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

double Gaussian(double x, double sigma) {
  return std::exp(-x * x / (2 * sigma * sigma)) /
         (std::sqrt(2 * std::numbers::pi) * sigma);
}

// Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", eq. 8;
// x in [-2, 2].
double Mitchell(double x, double b, double c) {
  const double a = std::abs(x);
  if (a >= 2) return 0;
  if (a >= 1) {
    return (((-b - 6 * c) * a + (6 * b + 30 * c)) * a - (12 * b + 48 * c)) * a / 6 +
           (8 * b + 24 * c) / 6;
  }
  return ((12 - 9 * b - 6 * c) * a - (18 - 12 * b - 6 * c)) * a * a / 6 + (6 - 2 * b) / 6;
}

double Sinc(double x) {
  const double t = std::numbers::pi * x;
  // Taylor: the next term is below 1e-18.
  return std::abs(t) < 1e-4 ? 1 - t * t / 6 : std::sin(t) / t;
}

// Integrates over [a, b] by Gauss-Legendre with four points on each of eight parts: exact
// for every polynomial filter, rounding for the others.
double IntegrateFilter(const Filter& filter, double radius, double a, double b) {
  constexpr std::array<double, 2> kNode = {0.33998104358485626, 0.86113631159405258};
  constexpr std::array<double, 2> kWeight = {0.65214515486254614, 0.34785484513745386};
  constexpr int kParts = 8;
  const double half = (b - a) / (2 * kParts);
  double sum = 0;
  for (int part = 0; part < kParts; ++part) {
    const double middle = a + (2 * part + 1) * half;
    for (int i = 0; i < 2; ++i) {
      sum += kWeight[i] * (EvaluateFilter(filter, radius, middle - kNode[i] * half) +
                           EvaluateFilter(filter, radius, middle + kNode[i] * half));
    }
  }
  return sum * half;
}

// Every bin gets the integral of the filter over it: its sign, and a share of the samples
// proportional to its magnitude. Returns integral |f| / integral f.
double CompileAxis(const Filter& filter, double radius, AlignedVector<float>& cdf,
                   AlignedVector<float>& sign) {
  constexpr int kSize = CompiledFilter::kSize;
  std::array<double, kSize + 1> sum{};
  double total = 0;
  sign.resize(kSize);
  for (int i = 0; i < kSize; ++i) {
    const double mass = IntegrateFilter(filter, radius, radius * (2.0 * i / kSize - 1),
                                        radius * (2.0 * (i + 1) / kSize - 1));
    total += mass;
    sum[i + 1] = sum[i] + std::abs(mass);
    sign[i] = mass < 0 ? -1.0f : 1.0f;
  }
  if (!(total > 0) || !std::isfinite(total)) {
    throw InputError(
        fmt::format("the pixel filter integrates to {} along one axis (radius {}); only "
                    "filters with a positive integral are supported",
                    total, radius));
  }
  cdf.resize(kSize + 1);
  for (int i = 0; i <= kSize; ++i) cdf[i] = static_cast<float>(sum[i] / sum[kSize]);
  return sum[kSize] / total;
}

void CheckRadius(double radius) {
  if (radius > 0 && std::isfinite(radius)) return;
  throw InputError(
      fmt::format("the radius of the pixel filter is {}; it must be positive", radius));
}

}  // namespace

double EvaluateFilter(const Filter& filter, double radius, double x) {
  if (std::abs(x) > radius) return 0;
  switch (filter.kind) {
    case FilterKind::kBox:
      return 1;
    case FilterKind::kTriangle:
      return radius - std::abs(x);
    case FilterKind::kGaussian:
      // The value at the edge is subtracted: the filter goes to zero there.
      return std::max(0.0, Gaussian(x, filter.sigma) - Gaussian(radius, filter.sigma));
    case FilterKind::kMitchell:
      return Mitchell(2 * x / radius, filter.b, filter.c);
    case FilterKind::kLanczos:
      return Sinc(x) * Sinc(x / filter.tau);
  }
  return 0;
}

CompiledFilter CompileFilter(const Filter& filter) {
  CheckRadius(filter.x_radius);
  CheckRadius(filter.y_radius);
  CompiledFilter out;
  out.x_radius = static_cast<float>(filter.x_radius);
  out.y_radius = static_cast<float>(filter.y_radius);
  out.is_box = filter.kind == FilterKind::kBox;
  if (out.is_box) return out;
  const double wx = CompileAxis(filter, filter.x_radius, out.x_cdf, out.x_sign);
  const double wy = CompileAxis(filter, filter.y_radius, out.y_cdf, out.y_sign);
  out.weight = static_cast<float>(wx * wy);
  return out;
}

}  // namespace lanelight
