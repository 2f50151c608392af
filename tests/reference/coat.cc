// Coats as an explicit random walk between two parallel layers: a dielectric interface on
// top and a diffuse or metallic layer below, seen alike from both sides (the layers are
// turned to face wo). The medium between them has unit extinction: pbrt-v4 attenuates
// each crossing by exp(-thickness / |cos|) even where no scattering medium is asked for.
//
// The walk has at most coat_max_depth events after the first entry, bottom and top in
// turn, as pbrt's layered BxDF counts them: with the default of 10, five bounces off the
// bottom. There is no roulette inside. With an albedo the medium scatters too, which
// counts as an event like the others.
#include "src/base/core/check.h"
#include "tests/reference/bsdf.h"
#include "tests/reference/media.h"

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

// Where a walk is between the layers, and where it goes.
struct Walker {
  double height;  // above the bottom
  Vec3d w;
};
enum class Place { kBottom, kTop, kMedium };

Place Move(const LocalMaterial& m, Walker& walker, Random& random) {
  walker.height -= std::log(1 - random.Uniform()) * walker.w.z;
  if (walker.height > 0 && walker.height < m.thickness) return Place::kMedium;
  const bool top = walker.w.z > 0;
  walker.height = top ? m.thickness : 0;
  return top ? Place::kTop : Place::kBottom;
}

std::optional<BsdfSample> Interact(const LocalMaterial& m, Place place, Vec3d w,
                                   Random& random) {
  if (place == Place::kMedium) {
    return BsdfSample{SamplePhaseFunction(m.g, w, random), m.albedo, false};
  }
  if (place == Place::kBottom) return SampleBottom(m, -w, random);
  return SampleDielectric(m.interface, m.index, -w, random);
}

// As ConnectThroughSmoothTop, from anywhere; the phase function comes without a cosine.
Rgb ConnectFrom(const LocalMaterial& m, Place place, const Walker& at, Vec3d wi) {
  const double cos_up = RefractedCosine(wi.z, m.index);
  if (cos_up <= 0) return {};
  const Vec3d up = {wi.x / m.index, wi.y / m.index, cos_up};
  const double medium = std::exp((at.height - m.thickness) / cos_up);
  const double through = (1 - FresnelDielectric(wi.z, m.index)) * medium;
  const Rgb scattered = place == Place::kMedium
                            ? m.albedo * PhaseFunction(m.g, Dot(at.w, up))
                            : EvaluateBottomCos(m, -at.w, up);
  return scattered * (through * wi.z / cos_up);
}

// wo and wi above.
Rgb EvaluateScattering(const LocalMaterial& m, Vec3d wo, Vec3d wi, Random& random) {
  const bool smooth_top = m.interface.smooth() || m.index == 1;
  Rgb total = Rgb{1, 1, 1} * EvaluateDielectricCos(m.interface, m.index, wo, wi);
  const auto entry = SampleDielectric(m.interface, m.index, wo, random);
  if (!entry || entry->wi.z > 0) return total;
  Rgb beta = entry->weight;
  Walker walker = {m.thickness, entry->wi};
  for (int event = 0; event + 1 < m.coat_max_depth; ++event) {
    const Place place = Move(m, walker, random);
    const bool mirror = place == Place::kBottom && BottomIsSmooth(m);
    if (smooth_top && place != Place::kTop && !mirror) {
      total += beta * ConnectFrom(m, place, walker, wi);
    }
    const auto next = Interact(m, place, walker.w, random);
    if (!next || (place == Place::kTop && next->wi.z > 0)) break;
    beta = beta * next->weight;
    walker.w = next->wi;
    if (smooth_top || place == Place::kTop || walker.w.z <= 0) continue;
    const double medium = std::exp((walker.height - m.thickness) / walker.w.z);
    total += beta * (EvaluateDielectricCos(m.interface, m.index, -walker.w, wi) * medium);
  }
  return total;
}

std::optional<BsdfSample> SampleScattering(const LocalMaterial& m,
                                           const BsdfSample& entry, Random& random) {
  Rgb beta = entry.weight;
  Walker walker = {m.thickness, entry.wi};
  bool mirror = false;  // the last event was one
  for (int event = 0; event < m.coat_max_depth; ++event) {
    const Place place = Move(m, walker, random);
    const auto next = Interact(m, place, walker.w, random);
    if (!next) return std::nullopt;
    beta = beta * next->weight;
    walker.w = next->wi;
    if (place == Place::kTop && walker.w.z > 0) {
      return BsdfSample{walker.w, beta, next->specular && mirror};
    }
    mirror = place == Place::kBottom && BottomIsSmooth(m);
  }
  return std::nullopt;
}

}  // namespace

Rgb EvaluateCoatCos(const LocalMaterial& m, Vec3d wo, Vec3d wi, Random& random) {
  if (wo.z * wi.z <= 0) return {};
  if (wo.z < 0) return EvaluateCoatCos(m, FlipZ(wo), FlipZ(wi), random);
  if (m.albedo != Rgb{}) return EvaluateScattering(m, wo, wi, random);
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
  if (m.albedo != Rgb{}) return SampleScattering(m, *step, random);
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
