#include "src/measure/stress/closed_forms.h"

#include "src/base/core/pi.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace lanelight::stress {
namespace {

// Returns the fraction of light that crosses a coat of this thickness from outside at
// `cosine`, or, with 1 / eta, from inside. The distance inside depends on the refracted
// direction.
double Passes(double cosine, double eta, double thickness, bool from_inside) {
  const double inside = from_inside ? cosine : RefractedCosine(cosine, eta);
  return (1 - FresnelDielectric(cosine, eta)) * std::exp(-thickness / inside);
}

}  // namespace

double ClosedRoom(double emission, double albedo, double depth) {
  if (albedo == 1) return emission * (depth + 1);
  // 1 - albedo^(depth + 1) without cancellation.
  return emission * -std::expm1((depth + 1) * std::log(albedo)) / (1 - albedo);
}

double PolygonIrradiance(std::span<const Vec3d> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i], b = corners[(i + 1) % corners.size()];
    const Vec3d plane = Cross(a, b);
    sum += std::atan2(Length(plane), Dot(a, b)) * plane.z / Length(plane);
  }
  return std::abs(sum) / 2;
}

double SquareSolidAngle(double half, double height) {
  return 4 * std::atan(half * half / height / std::hypot(std::sqrt(2.0) * half, height));
}

double RefractedCosine(double cosine, double eta) {
  // eta^2 - 1 + c^2 in factors: no digits are lost for eta near 1.
  const double g2 = (eta - 1) * (eta + 1) + cosine * cosine;
  return g2 <= 0 ? 0 : std::sqrt(g2) / eta;
}

double FresnelDielectric(double cosine, double eta) {
  const double t = RefractedCosine(cosine, eta);
  if (t == 0) return 1;
  const double s = (cosine - eta * t) / (cosine + eta * t);
  const double p = (eta * cosine - t) / (eta * cosine + t);
  return (s * s + p * p) / 2;
}

double FresnelConductor(double cosine, double eta, double k) {
  const std::complex<double> n(eta, k);
  const std::complex<double> t = std::sqrt(n * n - (1 - cosine) * (1 + cosine));
  const double s = std::norm((cosine - t) / (cosine + t));
  const double p = std::norm((n * n * cosine - t) / (n * n * cosine + t));
  return (s + p) / 2;
}

double CoatFurnace(const Coat& coat, double cosine) {
  constexpr int kSteps = 100000;
  double exit = 0, inner = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = std::sqrt((i + 0.5) / kSteps);  // 2 c dc = d(c^2)
    exit += Passes(c, 1 / coat.eta, coat.thickness, true) / kSteps;
    inner +=
        FresnelDielectric(c, 1 / coat.eta) * std::exp(-2 * coat.thickness / c) / kSteps;
  }
  const double q = coat.albedo * inner;
  const double series = q == 1 ? coat.bounces : (1 - std::pow(q, coat.bounces)) / (1 - q);
  return FresnelDielectric(cosine, coat.eta) +
         Passes(cosine, coat.eta, coat.thickness, false) * coat.albedo * series * exit;
}

}  // namespace lanelight::stress
