#include "src/scene/compile/coat_table.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

constexpr double kSmoothAlpha = 1e-3;  // below it pbrt-v4 treats an interface as smooth

double Fresnel(double c, double eta) {
  const double cos_t2 = 1 - (1 - c * c) / (eta * eta);
  if (cos_t2 <= 0) return 1;
  const double cos_t = std::sqrt(cos_t2);
  const double parallel = (eta * c - cos_t) / (eta * c + cos_t);
  const double perpendicular = (c - eta * cos_t) / (c + eta * cos_t);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

double Crossing(double thickness, double cosine) { return std::exp(-thickness / cosine); }

// One interface, seen from the side of incidence; eta is transmitted over incident.
struct Side {
  double alpha, eta, thickness;
  bool absorb_reflected, absorb_transmitted;  // which outcome crosses the medium
};
struct Fluxes {
  double reflected = 0, transmitted = 0;
};

Fluxes Smooth(const Side& s, double mu) {
  const double f = Fresnel(mu, s.eta);
  Fluxes out{f, 1 - f};
  if (s.absorb_reflected) out.reflected *= Crossing(s.thickness, mu);
  if (s.absorb_transmitted && f < 1) {
    const double cos_t = std::sqrt(1 - (1 - mu * mu) / (s.eta * s.eta));
    out.transmitted *= Crossing(s.thickness, cos_t);
  }
  return out;
}

// Contribution of a microfacet normal m, of those visible from wo = (x, 0, mu): its
// outcomes weighed by G2 / G1, zero when they end on the wrong side.
void AddMicrofacet(const Side& s, const Vec3d& wo, const Vec3d& m, double weight,
                   Fluxes* sum) {
  const double mu = wo.z, c = std::max(0., wo.x * m.x + mu * m.z);
  const double f = Fresnel(c, s.eta);
  const double a2 = s.alpha * s.alpha;
  const auto lambda = [a2](double z) {
    return (std::sqrt(1 + a2 * (1 - z * z) / (z * z)) - 1) / 2;
  };
  const double lambda_o = lambda(mu);
  const auto masking = [&](double z) {
    return (1 + lambda_o) / (1 + lambda_o + lambda(z));
  };
  const double reflected_z = 2 * c * m.z - mu;
  if (reflected_z > 0) {
    const double medium = s.absorb_reflected ? Crossing(s.thickness, reflected_z) : 1;
    sum->reflected += weight * f * masking(reflected_z) * medium;
  }
  if (f >= 1) return;
  const double cos_t = std::sqrt(1 - (1 - c * c) / (s.eta * s.eta));
  const double depth = mu / s.eta - (c / s.eta - cos_t) * m.z;  // -z of the refracted
  if (depth > 0) {
    const double medium = s.absorb_transmitted ? Crossing(s.thickness, depth) : 1;
    sum->transmitted += weight * (1 - f) * masking(depth) * medium;
  }
}

// Integral over the normals visible from mu, through the spherical cap that they are
// uniform over when stretched (Dupuy and Benyoub 2023). Midpoints: periodic in phi.
Fluxes Rough(const Side& s, double mu, int rings, int spokes) {
  const double x = std::sqrt(1 - mu * mu);
  const double length = std::hypot(s.alpha * x, mu);
  const double vx = s.alpha * x / length, vz = mu / length;
  std::vector<Vec3d> around(spokes);  // of the halves of a circle, which are alike
  for (int j = 0; j < spokes; ++j) {
    const double phi = std::numbers::pi * (j + 0.5) / spokes;
    around[j] = {std::cos(phi), std::sin(phi), 0};
  }
  Fluxes sum;
  for (int i = 0; i < rings; ++i) {
    const double height = (1 - (i + 0.5) / rings) * (1 + vz), z = height - vz;
    const double r = std::sqrt(std::max(0., 1 - z * z));
    for (const Vec3d& at : around) {
      const Vec3d h = {s.alpha * (r * at.x + vx), s.alpha * r * at.y, height};
      AddMicrofacet(s, {x, 0, mu}, Normalize(h), 1. / (rings * spokes), &sum);
    }
  }
  return sum;
}

Fluxes At(const Side& s, double mu, int rings, int spokes) {
  return s.alpha < kSmoothAlpha ? Smooth(s, mu) : Rough(s, mu, rings, spokes);
}

}  // namespace

CoatTable ComputeCoatTable(double alpha, double eta, double thickness) {
  LL_CHECK_GE(alpha, 0);
  LL_CHECK_GT(eta, 0);
  LL_CHECK_GE(thickness, 0);
  LL_CHECK(std::isfinite(alpha) && std::isfinite(eta) && std::isfinite(thickness));
  CoatTable table;
  const Side outside = {alpha, eta, thickness, false, true};
  for (int i = 0; i < kCoatTableSize; ++i) {
    // At mu = 0 exactly nothing is transmitted in the limit; an offset keeps it finite.
    const double mu = std::max(1e-6, i / (kCoatTableSize - 1.));
    table.transmittance[i] = static_cast<float>(At(outside, mu, 48, 24).transmitted);
  }
  // Mean over a cosine distribution: density 2 mu. The light has crossed the medium once
  // on its way to the interface.
  const Side inside = {alpha, 1 / eta, thickness, true, false};
  const int nodes = alpha < kSmoothAlpha ? 20000 : 64;
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double mu = (i + 0.5) / nodes;
    sum += 2 * mu * Crossing(thickness, mu) * At(inside, mu, 64, 8).reflected;
  }
  table.internal_reflectance = static_cast<float>(sum / nodes);
  return table;
}

}  // namespace lanelight
