// Closed forms and integrals in double precision that cases are held against. None of
// them shares a formula with the renderer where another one is known. Angles in radians,
// cosines in [0, 1].
#pragma once

#include <functional>
#include <span>

#include "src/base/core/vec.h"

namespace lanelight::stress {

/// Radiance in a closed room whose walls emit `emission` and reflect `albedo`: L = Le +
/// albedo L in every direction; with at most `depth` scattering events the geometric
/// series ends after albedo^depth.
double ClosedRoom(double emission, double albedo, double depth);

/// Irradiance at the origin, normal (0, 0, 1), from a polygon of radiance 1 above the
/// horizon: half the sum of the edges' angles times the cosine of their planes' normals
/// (Lambert 1760).
double PolygonIrradiance(std::span<const Vec3d> corners);

/// Solid angle of the square |x|, |y| <= half in the plane z = 0, seen from (0, 0,
/// height): 4 atan(half^2 / (height sqrt(2 half^2 + height^2))).
double SquareSolidAngle(double half, double height);

/// Reflectance of a dielectric of relative index eta (transmitted over incident) for
/// unpolarised light, by Fresnel's amplitudes; 1 under total reflection.
double FresnelDielectric(double cosine, double eta);
/// Cosine after refraction, by Snell's law; 0 under total reflection.
double RefractedCosine(double cosine, double eta);
/// Reflectance of a metal of index eta + i k, by Fresnel's amplitudes in complex numbers.
double FresnelConductor(double cosine, double eta, double k);

/// Fractions of light that a GGX surface reflects and transmits in single scattering, for
/// light from a direction of this cosine in the plane of x and z.
struct GgxAlbedo {
  double reflected = 0, transmitted = 0;
};
/// Integral over the slopes of the microfacets (Walter et al. 2007) with the
/// height-correlated masking 1 / (1 + Lambda(o) + Lambda(i)) (Heitz 2014). `fresnel`:
/// reflectance by the cosine to a facet. `eta`: relative index of what is below; 0:
/// nothing passes. Midpoints in 512 x 512: error below 1e-4 for cosine >= 1e-3.
GgxAlbedo IntegrateGgx(double alpha_x, double alpha_y, double cosine, double eta,
                       const std::function<double(double)>& fresnel);

/// A diffuse base under a smooth coat in a furnace of radiance 1, seen at `cosine`.
struct Coat {
  double albedo = 0.5, eta = 1.5, thickness = 0;
  int bounces = 1 << 20;  // off the base, at most
};
/// Reflection R, or entry T = (1 - F) e^(-t / cos'), any number of bounces between base
/// and coat, exit: R + T albedo S E with S the geometric series of albedo times the
/// coat's inner reflectance and E what leaves of diffuse light. Integrals by midpoints of
/// the squared cosine, in 1e5: error below 1e-6.
double CoatFurnace(const Coat& coat, double cosine);

}  // namespace lanelight::stress
