#include "tests/reference/material.h"

#include "src/base/core/check.h"
#include "src/base/core/pi.h"

namespace lanelight::reference {
namespace {

struct Lookup {
  const SurfacePoint& at;
  const TextureLookup& texture;

  Rgb Color(const ColorValue& value) const {
    if (value.texture == kNone) return value.constant;
    LL_CHECK(texture != nullptr);
    return texture(value.texture, {at.u, at.v, at.p, at.ng});
  }
  double Float(const FloatValue& value) const {
    return Color({{value.constant, 0, 0}, value.texture}).x;
  }
  double Alpha(const FloatValue& roughness, bool remap) const {
    const double r = Float(roughness);
    return remap ? std::sqrt(std::max(r, 0.0)) : std::max(r, 0.0);
  }
  Ggx Distribution(const FloatValue& u, const FloatValue& v, bool remap) const {
    Ggx ggx = {Alpha(u, remap), Alpha(v, remap)};
    if (!ggx.smooth()) {
      ggx.ax = std::max(ggx.ax, 1e-4);
      ggx.ay = std::max(ggx.ay, 1e-4);
    }
    return ggx;
  }
};

Rgb Clamp(Rgb c, double low, double high) {
  return {std::clamp(c.x, low, high), std::clamp(c.y, low, high),
          std::clamp(c.z, low, high)};
}

// k of an index 1 + i k with this reflectance r at normal incidence:
// r = k^2 / (4 + k^2), so k = 2 sqrt(r / (1 - r)).
Rgb AbsorptionFromReflectance(Rgb r) {
  r = Clamp(r, 0, 0.9999);
  const auto k = [](double v) { return 2 * std::sqrt(v / (1 - v)); };
  return {k(r.x), k(r.y), k(r.z)};
}

// Returns the absorption that gives much hair this colour (Chiang et al. 2016, equation
// 9).
Rgb HairAbsorption(Rgb r, double n) {
  const double k = 5.969 - 0.215 * n + 2.532 * n * n - 10.73 * std::pow(n, 3) +
                   5.574 * std::pow(n, 4) + 0.245 * std::pow(n, 5);
  const auto sigma = [&](double c) { return std::pow(std::log(c) / k, 2); };
  return {sigma(r.x), sigma(r.y), sigma(r.z)};
}

void SetHair(const Material& m, const SurfacePoint& at, LocalMaterial& out) {
  out.beta_m = std::max(m.beta_m, 0.01);
  out.beta_n = std::max(m.beta_n, 0.01);
  out.tilt = m.tilt / 180 * kPi;
  out.h = 2 * at.v - 1;
  out.sigma_a =
      m.has_reflectance ? HairAbsorption(out.reflectance, out.beta_n) : m.sigma_a;
}

}  // namespace

LocalMaterial EvaluateMaterial(const SceneDescription& scene, Index index,
                               const SurfacePoint& at, const TextureLookup& texture,
                               Random& random) {
  const Lookup look = {at, texture};
  const Material* m = &scene.materials.at(index);
  while (m->kind == MaterialKind::kMix) {
    const bool second = random.Uniform() < look.Float(m->mix_amount);
    m = &scene.materials.at(m->mix[second ? 1 : 0]);
    LL_CHECK(m->kind != MaterialKind::kInterface);
  }
  const bool coat = m->kind == MaterialKind::kCoatedDiffuse ||
                    m->kind == MaterialKind::kCoatedConductor;
  LocalMaterial out;
  out.source = m;
  out.kind = m->kind;
  out.scattering = m->scattering;
  out.reflectance = Clamp(look.Color(m->reflectance) * m->scale, 0, 1);
  out.transmittance = Clamp(look.Color(m->transmittance) * m->scale, 0, 1);
  out.index = m->interface_eta;
  out.interface = look.Distribution(m->uroughness, m->vroughness, m->remap_roughness);
  out.metal = look.Distribution(m->conductor_uroughness, m->conductor_vroughness,
                                m->remap_roughness);
  out.thickness = std::max(look.Float({m->thickness, m->thickness_texture}), 0.0);
  out.albedo = coat ? Clamp(look.Color(m->coat_albedo), 0, 1) : Rgb{};
  out.g = look.Float(m->coat_g);
  out.coat_max_depth = m->coat_max_depth;
  out.measured = m->measured;
  if (m->kind == MaterialKind::kHair) SetHair(*m, at, out);
  if (m->kind == MaterialKind::kConductor || m->kind == MaterialKind::kCoatedConductor) {
    const bool from_reflectance = m->has_reflectance;
    out.eta = from_reflectance ? Rgb{1, 1, 1} : look.Color(m->eta);
    out.k = from_reflectance ? AbsorptionFromReflectance(look.Color(m->reflectance))
                             : look.Color(m->k);
    if (coat) {  // seen from inside the coat, the index is relative to it
      out.eta = out.eta / m->interface_eta;
      out.k = out.k / m->interface_eta;
    }
  }
  return out;
}

void Regularize(LocalMaterial& material) {
  for (double* alpha : {&material.interface.ax, &material.interface.ay,
                        &material.metal.ax, &material.metal.ay}) {
    if (*alpha < 0.3) *alpha = std::min(std::max(2 * *alpha, 0.1), 0.3);
  }
}

LocalMaterial MadeDiffuse(const LocalMaterial& material, Vec3d wo, Random& random) {
  const auto sample = SampleBsdf(material, wo, random);
  LocalMaterial even;
  even.source = material.source;
  even.reflectance = sample ? sample->weight : Rgb{};
  return even;
}

}  // namespace lanelight::reference
