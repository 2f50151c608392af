// Scattering at a surface, in a local frame with the shading normal along +z; `wo` points
// to where the path came from (the camera), `wi` to where it goes on (the light).
// Radiance is what is transported: crossing into a medium of relative index eta scales it
// by 1 / eta^2.
//
// No density is ever needed: the estimators of the reference tracer do not combine
// strategies, so a sample carries only its weight.
#pragma once

#include <optional>

#include "src/base/image/measured_reflectance.h"
#include "src/scene/description/description.h"
#include "tests/reference/optics.h"
#include "tests/reference/random.h"

namespace lanelight::reference {

/// Mirrored at the surface.
inline Vec3d FlipZ(Vec3d v) { return {v.x, v.y, -v.z}; }

/// A material with its textures looked up at one point.
struct LocalMaterial {
  const Material* source = nullptr;  // of the scene, after mixes
  MaterialKind kind = MaterialKind::kDiffuse;
  Scattering scattering = Scattering::kLambertian;
  Rgb reflectance, transmittance;
  Rgb eta, k;            // metal, relative to what is above it
  double index = 1.5;    // dielectric: inside (-z) over outside (+z)
  Ggx interface;         // of the outer interface
  Ggx metal;             // of the metal below a coat
  double thickness = 0;  // coats
  Rgb albedo;            // of the medium in a coat; 0: it absorbs
  double g = 0;          // and its asymmetry
  int coat_max_depth = 10;
  std::shared_ptr<const MeasuredReflectance> measured;
  // Hair: absorption, roughness along and around, tilt of scales (radians), where across.
  Rgb sigma_a;
  double beta_m = 0.3, beta_n = 0.3, tilt = 0, h = 0;
};

struct BsdfSample {
  Vec3d wi;
  Rgb weight;             // f |cos| / density
  bool specular = false;  // a direction that EvaluateCos knows nothing of
};

/// An unbiased estimate of f(wo, wi) |wi.z|, without perfectly specular parts.
Rgb EvaluateCos(const LocalMaterial& material, Vec3d wo, Vec3d wi, Random& random);
/// Empty: absorbed.
std::optional<BsdfSample> SampleBsdf(const LocalMaterial& material, Vec3d wo,
                                     Random& random);

// ---- Building blocks, also used by the layers of coats ------------------------------
double EvaluateDielectricCos(const Ggx& ggx, double index, Vec3d wo, Vec3d wi);
std::optional<BsdfSample> SampleDielectric(const Ggx& ggx, double index, Vec3d wo,
                                           Random& random);
Rgb EvaluateConductorCos(const Ggx& ggx, Rgb eta, Rgb k, Vec3d wo, Vec3d wi);
std::optional<BsdfSample> SampleConductor(const Ggx& ggx, Rgb eta, Rgb k, Vec3d wo,
                                          Random& random);
/// Density, per solid angle, of the scattered direction of a diffuse model at this
/// cosine.
double DiffuseDensity(Scattering scattering, double cosine);
/// Direction in the upper hemisphere with that density.
Vec3d SampleDiffuse(Scattering scattering, Random& random);
Rgb EvaluateHairCos(const LocalMaterial& material, Vec3d wo, Vec3d wi);
Rgb EvaluateCoatCos(const LocalMaterial& material, Vec3d wo, Vec3d wi, Random& random);
std::optional<BsdfSample> SampleCoat(const LocalMaterial& material, Vec3d wo,
                                     Random& random);

}  // namespace lanelight::reference
