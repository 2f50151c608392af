#include "src/scene/compile/coat.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/image/upsampling.h"

namespace lanelight {

namespace {

constexpr double kSmoothCoatAlpha =
    1e-3;  // below it pbrt-v4 treats an interface as smooth

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
struct CoatSide {
  double alpha, eta, thickness;
  bool absorb_reflected, absorb_transmitted;  // which outcome crosses the medium
};
struct Fluxes {
  double reflected = 0, transmitted = 0;
};

Fluxes Smooth(const CoatSide& s, double mu) {
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
void AddMicrofacet(const CoatSide& s, const Vec3d& wo, const Vec3d& m, double weight,
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

// Integrates over the normals visible from mu, which are uniform over a stretched
// spherical cap (Dupuy and Benyoub 2023), at midpoints, since phi is periodic.
Fluxes Rough(const CoatSide& s, double mu, int rings, int spokes) {
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

Fluxes At(const CoatSide& s, double mu, int rings, int spokes) {
  return s.alpha < kSmoothCoatAlpha ? Smooth(s, mu) : Rough(s, mu, rings, spokes);
}

// Returns the rho in [0, 1] of a response, by bisection of an increasing function.
double InvertResponse(double response, double internal, int bounces) {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (CoatedResponse(middle, internal, bounces) < response ? low : high) = middle;
  }
  return (low + high) / 2;
}

constexpr std::size_t kFitNodes = kCoatFitNodes * kCoatFitNodes * kCoatFitNodes;

Rgb ColorOfNode(std::size_t i) {
  constexpr std::size_t n = kCoatFitNodes;
  const auto level = [](std::size_t at) { return at / (n - 1.0); };
  return {level(i % n), level(i / n % n), level(i / n / n)};
}

}  // namespace

CoatTable ComputeCoatTable(double alpha, double eta, double thickness) {
  LL_CHECK_GE(alpha, 0);
  LL_CHECK_GT(eta, 0);
  LL_CHECK_GE(thickness, 0);
  LL_CHECK(std::isfinite(alpha) && std::isfinite(eta) && std::isfinite(thickness));
  CoatTable table;
  const CoatSide outside = {alpha, eta, thickness, false, true};
  for (int i = 0; i < kCoatTableSize; ++i) {
    // At mu = 0 exactly nothing is transmitted in the limit; an offset keeps it finite.
    const double mu = std::max(1e-6, i / (kCoatTableSize - 1.));
    table.transmittance[i] = static_cast<float>(At(outside, mu, 48, 24).transmitted);
  }
  // Mean over a cosine distribution: density 2 mu. The light has crossed the medium once
  // on its way to the interface.
  const CoatSide inside = {alpha, 1 / eta, thickness, true, false};
  const int nodes = alpha < kSmoothCoatAlpha ? 20000 : 64;
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double mu = (i + 0.5) / nodes;
    sum += 2 * mu * Crossing(thickness, mu) * At(inside, mu, 64, 8).reflected;
  }
  table.internal_reflectance = static_cast<float>(sum / nodes);
  return table;
}

double CoatedResponse(double rho, double internal, int bounces) {
  const double q = rho * internal;
  // (1 - q^n) / (1 - q); for q near 1 without cancellation.
  const double series = q == 1 ? bounces : -std::expm1(bounces * std::log(q)) / (1 - q);
  return rho * series;
}

Rgb EffectiveCoatBase(Rgb rgb, double internal, int bounces) {
  if (rgb.x == rgb.y && rgb.y == rgb.z) return rgb;
  const Spectrum base = ReflectanceOfRgb(Max(Min(rgb, {1, 1, 1}), {0, 0, 0}));
  return EffectiveCoatBase(rgb, base, internal, bounces);
}

Rgb EffectiveCoatBase(Rgb rgb, const Spectrum& base, double internal, int bounces) {
  const Rgb fitted = ColorUnderD65(base);
  const Rgb response = ColorUnderD65(
      [&](double nm) { return CoatedResponse(base(nm), internal, bounces); });
  Rgb effective;
  for (int c = 0; c < 3; ++c) {
    // The relative error of the fit is divided out, so that a linear response returns the
    // colour itself.
    const double miss = fitted[c] > 0.01 ? rgb[c] / fitted[c] : 1;
    const double wanted =
        fitted[c] > 0.01 ? response[c] * miss : CoatedResponse(rgb[c], internal, bounces);
    effective[c] = InvertResponse(std::max(wanted, 0.0), internal, bounces);
  }
  return effective;
}

std::vector<float> CoatFits::Table(double internal, int bounces) {
  if (bases_.empty()) {
    bases_.resize(kFitNodes);
    ParallelFor(kFitNodes,
                [&](std::size_t i) { bases_[i] = ReflectanceOfRgb(ColorOfNode(i)); });
  }
  std::vector<float> table(3 * kFitNodes);
  ParallelFor(kFitNodes, [&](std::size_t i) {
    const Rgb rgb = ColorOfNode(i);
    if (rgb.x == rgb.y && rgb.y == rgb.z) return;
    const Rgb change = EffectiveCoatBase(rgb, bases_[i], internal, bounces) - rgb;
    for (int c = 0; c < 3; ++c) table[3 * i + c] = static_cast<float>(change[c]);
  });
  return table;
}

}  // namespace lanelight
