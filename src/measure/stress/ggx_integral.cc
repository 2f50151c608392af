// Directional albedo of GGX, as an integral over slopes.
#include <cmath>
#include <numbers>

#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

// Lambda of Smith's masking of an ellipsoidal GGX surface (Heitz 2014, equation 72).
double Lambda(Vec3d w, double ax, double ay) {
  const double x = ax * w.x, y = ay * w.y;
  return (std::sqrt(1 + (x * x + y * y) / (w.z * w.z)) - 1) / 2;
}

struct Facets {
  double ax, ay, eta;
  Vec3d wo;
  double lambda_o;
  const std::function<double(double)>& fresnel;

  // Adds a facet of slopes (x, y), of this share of the area.
  void Add(double x, double y, double fraction, GgxAlbedo* sum) const {
    const double projected = wo.x * x + wo.z;  // (wo.m) / m.z
    if (projected <= 0) return;
    const Vec3d m = Normalize(Vec3d{x, y, 1});
    const double c = std::min(1.0, Dot(wo, m)), f = fresnel(c);
    const double weight = fraction * projected / wo.z;
    const Vec3d back = 2 * c * m - wo;
    if (back.z > 0) sum->reflected += weight * f * Masking(back);
    const double t = eta > 0 ? RefractedCosine(c, eta) : 0;
    if (t <= 0) return;
    const Vec3d through = (c / eta - t) * m - (1 / eta) * wo;
    if (through.z < 0) sum->transmitted += weight * (1 - f) * Masking(through);
  }
  double Masking(Vec3d wi) const { return 1 / (1 + lambda_o + Lambda(wi, ax, ay)); }
};

}  // namespace

GgxAlbedo IntegrateGgx(double alpha_x, double alpha_y, double cosine, double eta,
                       const std::function<double(double)>& fresnel) {
  constexpr int kSteps = 512;
  const Vec3d wo = {std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
  const Facets facets = {alpha_x, alpha_y, eta, wo, Lambda(wo, alpha_x, alpha_y),
                         fresnel};
  GgxAlbedo sum;
  for (int i = 0; i < kSteps; ++i) {
    // Stretched slopes have the distribution function u = r^2 / (1 + r^2); u = 1 - s^2
    // takes the root at u = 1 away, and du = 2 s ds.
    const double s = (i + 0.5) / kSteps, r = std::sqrt((1 - s) * (1 + s)) / s;
    for (int j = 0; j < kSteps; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / kSteps;
      facets.Add(alpha_x * r * std::cos(phi), alpha_y * r * std::sin(phi),
                 2 * s / (double(kSteps) * kSteps), &sum);
    }
  }
  return sum;
}

}  // namespace lanelight::stress
