// Closed forms that the tests hold every renderer against, in double precision. Each says
// where it comes from. Angles are in radians, cosines in [0, 1].
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "src/scene/description/description.h"

namespace lanelight::closed_form {

/// Radiance of a convex diffuse body of this albedo under a uniform environment: every
/// diffuse model turns a fraction `albedo` of the path's weight to a direction that
/// leaves the body and meets the environment.
inline double Furnace(double albedo, double environment) { return albedo * environment; }

/// Radiance inside a closed room whose walls all emit `emission` and reflect `albedo`
/// diffusely: L = Le + albedo L everywhere, in every direction. With at most `max_depth`
/// scattering events the geometric series stops after albedo^max_depth.
inline double ClosedRoom(double emission, double albedo) {
  return emission / (1 - albedo);
}
inline double ClosedRoom(double emission, double albedo, int max_depth) {
  if (albedo == 1) return emission * (max_depth + 1);
  return emission * (1 - std::pow(albedo, max_depth + 1)) / (1 - albedo);
}

/// Density per solid angle of a diffuse model's scattered direction: Lambert cos / pi;
/// uniform 1 / (2 pi); in-sphere 2 cos^3 / pi.
inline double ScatteringDensity(Scattering scattering, double cosine) {
  switch (scattering) {
    case Scattering::kLambertian:
      return cosine / std::numbers::pi;
    case Scattering::kUniform:
      return 0.5 / std::numbers::pi;
    case Scattering::kInSphere:
      return 2 * cosine * cosine * cosine / std::numbers::pi;
  }
  return 0;
}

/// E[cos] of that density, 2 pi int_0^1 density(c) c dc: 2/3, 1/2, 4/5.
inline double MeanCosine(Scattering scattering) {
  switch (scattering) {
    case Scattering::kLambertian:
      return 2.0 / 3;
    case Scattering::kUniform:
      return 0.5;
    case Scattering::kInSphere:
      return 0.8;
  }
  return 0;
}
/// E[cos^2] of that density: 1/2, 1/3, 2/3.
inline double MeanSquaredCosine(Scattering scattering) {
  switch (scattering) {
    case Scattering::kLambertian:
      return 0.5;
    case Scattering::kUniform:
      return 1.0 / 3;
    case Scattering::kInSphere:
      return 2.0 / 3;
  }
  return 0;
}

/// Radiance that a plane reflects of one point light of `intensity` (W/sr) at `distance`,
/// the light at `cosine` to the normal: the path weight albedo times the density of the
/// direction to the light, times I / r^2. Lambert: albedo/pi I cos / r^2.
inline double PointLightOnPlane(Scattering scattering, double albedo, double intensity,
                                double distance, double cosine) {
  return albedo * ScatteringDensity(scattering, cosine) * intensity /
         (distance * distance);
}

/// Returns the irradiance from a sphere of uniform radiance whose whole disk is above the
/// horizon: pi L (radius / distance)^2 cos, distance to the centre. (The projected solid
/// angle of a cone of half angle asin(r/d) tilted by theta is pi sin^2 cos theta.)
inline double SphereLightIrradiance(double radiance, double radius, double distance,
                                    double cosine) {
  const double sine = radius / distance;
  return std::numbers::pi * radiance * sine * sine * cosine;
}

/// Irradiance at `p` with unit normal `n` from a polygon of uniform radiance that lies
/// wholly above the horizon (Lambert 1760): E = L/2 |sum_i gamma_i n.(v_i x v_i+1)^|,
/// gamma_i the angle between the directions to neighbouring corners; the vector
/// irradiance is Stokes' theorem turned into a sum over edges.
inline double PolygonIrradiance(double radiance, std::span<const Vec3d> corners, Vec3d p,
                                Vec3d n) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i] - p, b = corners[(i + 1) % corners.size()] - p;
    const Vec3d cross = Cross(a, b);
    const double angle = std::atan2(Length(cross), Dot(a, b));
    sum += angle * Dot(n, Normalize(cross));
  }
  return radiance / 2 * std::abs(sum);
}

/// Reflectance at normal incidence of a metal of index eta + i k.
inline double ConductorNormal(double eta, double k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

/// Cosine after refraction into relative index eta; -1 on total internal reflection.
inline double Snell(double cosine, double eta) {
  const double c2 = 1 - (1 - cosine * cosine) / (eta * eta);
  return c2 <= 0 ? -1 : std::sqrt(c2);
}

/// Unpolarised Fresnel reflectance in the angle form: (sin^2(i-t)/sin^2(i+t) +
/// tan^2(i-t)/tan^2(i+t)) / 2; at normal incidence ((eta-1)/(eta+1))^2.
inline double Fresnel(double cosine, double eta) {
  const double cos_t = Snell(cosine, eta);
  if (cos_t < 0) return 1;
  const double i = std::acos(std::min(cosine, 1.0)), t = std::acos(std::min(cos_t, 1.0));
  if (i < 1e-7) return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));
  const double s = std::sin(i - t) / std::sin(i + t),
               p = std::tan(i - t) / std::tan(i + t);
  return (s * s + p * p) / 2;
}

/// A slab of lossless glass, all inner reflections added up: with R of one face,
/// reflected 2R/(1+R), transmitted (1-R)/(1+R).
inline double SlabReflectance(double cosine, double eta) {
  const double r = Fresnel(cosine, eta);
  return 2 * r / (1 + r);
}
inline double SlabTransmittance(double cosine, double eta) {
  const double r = Fresnel(cosine, eta);
  return (1 - r) / (1 + r);
}
/// Radiance seen through or in a slab after exactly k inner reflections: k = 0 the
/// straight transmission (1-R)^2, transmitted for even k, reflected for odd: (1-R)^2 R^k.
inline double SlabOrder(double cosine, double eta, int k) {
  const double r = Fresnel(cosine, eta);
  return (1 - r) * (1 - r) * std::pow(r, k);
}
/// How far along the face the ray moves inside per crossing of the slab: thickness tan t.
inline double SlabShift(double cosine, double eta, double thickness) {
  const double cos_t = Snell(cosine, eta);
  return thickness * std::sqrt(1 - cos_t * cos_t) / cos_t;
}
/// Distance between the straight and the transmitted parallel ray: thickness
/// sin(i - t) / cos t.
inline double SlabDisplacement(double cosine, double eta, double thickness) {
  const double cos_t = Snell(cosine, eta);
  return thickness * std::sin(std::acos(cosine) - std::acos(cos_t)) / cos_t;
}

/// Hemispherical reflectance of a dielectric face for diffuse light from the side where
/// the relative index is eta: 2 int_0^1 R(c) c dc, by the midpoint rule (error < 1e-6).
/// From inside, R_int = 1 - (1 - R_ext) / eta^2 follows from reciprocity.
inline double DiffuseFresnel(double eta) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    sum += Fresnel(c, eta) * c;
  }
  return 2 * sum / kSteps;
}

/// Radiance of a diffuse layer of this albedo under a smooth clear coat without
/// absorption, lit by a uniform environment of radiance 1, seen at `cosine`: reflection
/// R, or entry (1-R), any number of bounces between bottom and coat, exit: R + (1-R)
/// albedo (1 - R_int) / (1 - albedo R_int). With at most `bounces` off the bottom the
/// geometric series stops: times 1 - (albedo R_int)^bounces.
inline double CoatedFurnace(double albedo, double eta, double cosine,
                            double bounces = 1e9) {
  const double inside = 1 - (1 - DiffuseFresnel(eta)) / (eta * eta);
  const double r = Fresnel(cosine, eta), q = albedo * inside;
  return r + (1 - r) * albedo * (1 - inside) * (1 - std::pow(q, bounces)) / (1 - q);
}

}  // namespace lanelight::closed_form
