// Coats as an explicit random walk between two parallel layers: a dielectric interface on
// top and a diffuse or metallic layer below, seen alike from both sides (the layers are
// turned to face wo). The medium between them only absorbs: pbrt-v4 attenuates each
// crossing by exp(-thickness / |cos|) even where no scattering medium is asked for.
//
// The walk has at most coat_max_depth events after the first entry, bottom and top in
// turn, as pbrt's layered BxDF counts them: with the default of 10, five bounces off the
// bottom. There is no roulette inside.
#include "src/core/check.h"
#include "tests/reference/bsdf.h"

namespace lanelight::reference {
namespace {

double Transmittance(const LocalMaterial& m, Vec3d w) {
  return std::exp(-m.thickness / std::abs(w.z));
}

bool BottomIsSmooth(const LocalMaterial& m) {
  return m.kind == MaterialKind::kCoatedConductor && m.metal.smooth();
}

std::optional<BsdfSample> SampleBottom(const LocalMaterial& m, Vec3d wo, Random& random) {
  if (m.kind == MaterialKind::kCoatedConductor) {
    return SampleConductor(m.metal, m.eta, m.k, wo, random);
  }
  return BsdfSample{SampleDiffuse(Scattering::kLambertian, random), m.reflectance, false};
}

Rgb EvaluateBottomCos(const LocalMaterial& m, Vec3d wo, Vec3d wi) {
  if (m.kind == MaterialKind::kCoatedConductor) {
    return EvaluateConductorCos(m.metal, m.eta, m.k, wo, wi);
  }
  return m.reflectance * DiffuseDensity(Scattering::kLambertian, wi.z);
}

// Light that comes along wi through a smooth top is refracted to one direction `down`
// (seen from the bottom: `up`). With L_up = T L eta^2 and cos_up domega_up eta^2 =
// cos_i domega_i, what the bottom reflects of it is (f cos)(up) / cos_up * T cos_i L.
Rgb ConnectThroughSmoothTop(const LocalMaterial& m, Vec3d bottom_wo, Vec3d wi) {
  const double cos_up = RefractedCosine(wi.z, m.index);
  if (cos_up <= 0) return {};
  const Vec3d up = {wi.x / m.index, wi.y / m.index, cos_up};
  const double through = (1 - FresnelDielectric(wi.z, m.index)) * Transmittance(m, up);
  return EvaluateBottomCos(m, bottom_wo, up) * (through * wi.z / cos_up);
}

}  // namespace

Rgb EvaluateCoatCos(const LocalMaterial& m, Vec3d wo, Vec3d wi, Random& random) {
  if (wo.z * wi.z <= 0) return {};
  if (wo.z < 0) return EvaluateCoatCos(m, FlipZ(wo), FlipZ(wi), random);
  const bool smooth_top = m.interface.smooth() || m.index == 1;
  Rgb total = Rgb{1, 1, 1} * EvaluateDielectricCos(m.interface, m.index, wo, wi);
  const auto entry = SampleDielectric(m.interface, m.index, wo, random);
  if (!entry || entry->wi.z > 0) return total;
  Rgb beta = entry->weight;
  Vec3d w = entry->wi;
  // Each turn: down to the bottom, and (if the walk may still leave) up to the top.
  for (int event = 0; event + 1 < m.coat_max_depth; event += 2) {
    beta *= Transmittance(m, w);
    if (smooth_top && !BottomIsSmooth(m)) {
      total += beta * ConnectThroughSmoothTop(m, -w, wi);
    }
    const auto bottom = SampleBottom(m, -w, random);
    if (!bottom) break;
    w = bottom->wi;
    beta = beta * bottom->weight * Transmittance(m, w);
    if (!smooth_top) total += beta * EvaluateDielectricCos(m.interface, m.index, -w, wi);
    const auto top = SampleDielectric(m.interface, m.index, -w, random);
    if (!top || top->wi.z > 0) break;
    beta = beta * top->weight;
    w = top->wi;
  }
  return total;
}

std::optional<BsdfSample> SampleCoat(const LocalMaterial& m, Vec3d wo, Random& random) {
  if (wo.z < 0) {
    auto sample = SampleCoat(m, FlipZ(wo), random);
    if (sample) sample->wi = FlipZ(sample->wi);
    return sample;
  }
  auto step = SampleDielectric(m.interface, m.index, wo, random);
  if (!step || step->wi.z > 0) return step;
  Rgb beta = step->weight;
  bool specular = step->specular;
  for (int event = 0; event < m.coat_max_depth; ++event) {
    const Vec3d w = step->wi;
    beta *= Transmittance(m, w);
    const bool at_bottom = event % 2 == 0;
    step = at_bottom ? SampleBottom(m, -w, random)
                     : SampleDielectric(m.interface, m.index, -w, random);
    if (!step) return std::nullopt;
    beta = beta * step->weight;
    specular = specular && step->specular;
    if (!at_bottom && step->wi.z > 0) return BsdfSample{step->wi, beta, specular};
  }
  return std::nullopt;
}

}  // namespace lanelight::reference
