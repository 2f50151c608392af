#include "tests/reference/bsdf.h"

#include "src/base/core/check.h"
#include "src/base/core/pi.h"
#include "tests/reference/measured.h"

namespace lanelight::reference {
namespace {

constexpr Rgb kWhite = {1, 1, 1};

// Uniform in the unit ball, by rejection from the cube.
Vec3d SampleBall(Random& random) {
  for (;;) {
    const Vec3d p = {2 * random.Uniform() - 1, 2 * random.Uniform() - 1,
                     2 * random.Uniform() - 1};
    if (Dot(p, p) < 1) return p;
  }
}

std::optional<BsdfSample> SampleThin(double index, Vec3d wo, Random& random) {
  // Two parallel interfaces of reflectance r: r + t^2 r (1 + r^2 + ...) = 2r / (1 + r).
  const double r = FresnelDielectric(std::abs(wo.z), index);
  const bool reflect = random.Uniform() < 2 * r / (1 + r);
  const Vec3d wi = reflect ? Vec3d{-wo.x, -wo.y, wo.z} : -wo;
  return BsdfSample{wi, kWhite, true};
}

std::optional<BsdfSample> SampleTwoSidedDiffuse(const LocalMaterial& m, Vec3d wo,
                                                Random& random) {
  // A side is chosen in proportion to its largest channel.
  const bool transmits = m.kind == MaterialKind::kDiffuseTransmission;
  const auto peak = [](Rgb c) { return std::max({c.x, c.y, c.z}); };
  const double r = peak(m.reflectance), t = transmits ? peak(m.transmittance) : 0;
  if (!(r + t > 0)) return std::nullopt;
  const bool reflect = random.Uniform() * (r + t) < r;
  const Rgb weight =
      reflect ? m.reflectance * ((r + t) / r) : m.transmittance * ((r + t) / t);
  const Vec3d wi = SampleDiffuse(m.scattering, random);
  return BsdfSample{(wo.z > 0) == reflect ? wi : FlipZ(wi), weight, false};
}

// By the cosine, whatever the numbers say.
std::optional<BsdfSample> SampleMeasured(const MeasuredReflectance& m, Vec3d wo,
                                         Random& random) {
  const Vec3d up = SampleDiffuse(Scattering::kLambertian, random);
  const Vec3d wi = wo.z > 0 ? up : FlipZ(up);
  return BsdfSample{wi, EvaluateMeasuredCos(m, wo, wi) * (kPi / up.z), false};
}

}  // namespace

// Lambert: cos / pi. Uniform: 1 / (2 pi). In-sphere: a ball of radius 1 around the tip of
// the unit normal touches the surface at the origin. Along a direction at angle theta the
// ray stays in it for a length 2 cos. The ball thus holds the volume (2 cos)^3 / 3 per
// solid angle, out of 4 pi / 3: density 2 cos^3 / pi.
double DiffuseDensity(Scattering scattering, double cosine) {
  switch (scattering) {
    case Scattering::kLambertian:
      return cosine / kPi;
    case Scattering::kUniform:
      return 1 / (2 * kPi);
    case Scattering::kInSphere:
      return 2 * cosine * cosine * cosine / kPi;
  }
  LL_CHECK(false);
  return 0;
}

Vec3d SampleDiffuse(Scattering scattering, Random& random) {
  const Vec3d up = {0, 0, 1};
  const Vec3d p = SampleBall(random);
  switch (scattering) {
    case Scattering::kLambertian:
      return Normalize(up + Normalize(p));  // Shirley's trick
    case Scattering::kUniform:
      return Normalize(Vec3d{p.x, p.y, std::abs(p.z)});
    case Scattering::kInSphere:
      return Normalize(up + p);
  }
  LL_CHECK(false);
  return up;
}

// f cos_i = F D G / (4 cos_o), both directions on the same side.
Rgb EvaluateConductorCos(const Ggx& ggx, Rgb eta, Rgb k, Vec3d wo, Vec3d wi) {
  if (ggx.smooth() || wo.z * wi.z <= 0) return {};
  if (wo.z < 0) return EvaluateConductorCos(ggx, eta, k, FlipZ(wo), FlipZ(wi));
  const Vec3d m = Normalize(wo + wi);
  const double scale = ggx.D(m) * ggx.G(wo, wi) / (4 * wo.z);
  return FresnelConductor(Dot(wo, m), eta, k) * scale;
}

// The whole distribution of normals is sampled, density D(m) m.z, not only the visible
// ones. With dm = dwi / (4 wo.m) the weight is F G (wo.m) / (wo.z m.z).
std::optional<BsdfSample> SampleConductor(const Ggx& ggx, Rgb eta, Rgb k, Vec3d wo,
                                          Random& random) {
  if (wo.z < 0) {
    auto sample = SampleConductor(ggx, eta, k, FlipZ(wo), random);
    if (sample) sample->wi = FlipZ(sample->wi);
    return sample;
  }
  if (wo.z == 0) return std::nullopt;
  if (ggx.smooth()) {
    return BsdfSample{{-wo.x, -wo.y, wo.z}, FresnelConductor(wo.z, eta, k), true};
  }
  const Vec3d m = ggx.SampleNormal(random);
  const Vec3d wi = Reflect(wo, m);
  const double cosine = Dot(wo, m);
  if (cosine <= 0 || wi.z <= 0) return std::nullopt;
  const double scale = ggx.G(wo, wi) * cosine / (wo.z * m.z);
  return BsdfSample{wi, FresnelConductor(cosine, eta, k) * scale, false};
}

// Walter et al. 2007, eq. 20 and 21. Reflection: f cos_i = R D G / (4 cos_o).
// Transmission, with the normal m along +-(wo + eta wi), on the side of wo:
//   f cos_i = (1 - R) D G |wo.m| |wi.m| / (cos_o (wo.m + eta wi.m)^2),
// their n_o^2 / (n_i wi.m + n_o wo.m)^2 divided through by n_o^2.
double EvaluateDielectricCos(const Ggx& ggx, double index, Vec3d wo, Vec3d wi) {
  if (ggx.smooth() || index == 1 || wo.z == 0 || wi.z == 0) return 0;
  if (wo.z < 0) return EvaluateDielectricCos(ggx, 1 / index, FlipZ(wo), FlipZ(wi));
  if (wi.z > 0) {
    const Vec3d m = Normalize(wo + wi);
    return FresnelDielectric(Dot(wo, m), index) * ggx.D(m) * ggx.G(wo, wi) / (4 * wo.z);
  }
  Vec3d m = Normalize(wo + index * wi);
  if (m.z < 0) m = -m;
  const double o = Dot(wo, m), i = Dot(wi, m);
  if (o <= 0 || i >= 0) return 0;
  const double denominator = o + index * i;
  return (1 - FresnelDielectric(o, index)) * ggx.D(m) * ggx.G(wo, wi) * o * -i /
         (wo.z * denominator * denominator);
}

std::optional<BsdfSample> SampleDielectric(const Ggx& ggx, double index, Vec3d wo,
                                           Random& random) {
  if (wo.z < 0) {
    auto sample = SampleDielectric(ggx, 1 / index, FlipZ(wo), random);
    if (sample) sample->wi = FlipZ(sample->wi);
    return sample;
  }
  if (wo.z == 0) return std::nullopt;
  const bool smooth = ggx.smooth() || index == 1;
  const Vec3d m = smooth ? Vec3d{0, 0, 1} : ggx.SampleNormal(random);
  const double cos_i = Dot(wo, m);
  if (cos_i <= 0) return std::nullopt;
  // Choosing the lobe with probability R cancels the Fresnel factor; what remains is the
  // weight of the conductor, and 1 / eta^2 of the radiance on transmission.
  double scale = 1;
  Vec3d wi;
  if (random.Uniform() < FresnelDielectric(cos_i, index)) {
    wi = Reflect(wo, m);
    if (wi.z <= 0) return std::nullopt;
  } else {
    const double cos_t = RefractedCosine(cos_i, index);
    wi = -wo / index + (cos_i / index - cos_t) * m;
    if (wi.z >= 0) return std::nullopt;
    scale = 1 / (index * index);
  }
  if (!smooth) scale *= ggx.G(wo, wi) * cos_i / (wo.z * m.z);
  return BsdfSample{wi, scale * kWhite, smooth};
}

Rgb EvaluateCos(const LocalMaterial& m, Vec3d wo, Vec3d wi, Random& random) {
  const bool same_side = wo.z * wi.z > 0;
  switch (m.kind) {
    case MaterialKind::kDiffuse:
      if (!same_side) return {};
      return m.reflectance * DiffuseDensity(m.scattering, std::abs(wi.z));
    case MaterialKind::kDiffuseTransmission:
      return (same_side ? m.reflectance : m.transmittance) * (std::abs(wi.z) / kPi);
    case MaterialKind::kConductor:
      return EvaluateConductorCos(m.interface, m.eta, m.k, wo, wi);
    case MaterialKind::kDielectric:
      return kWhite * EvaluateDielectricCos(m.interface, m.index, wo, wi);
    case MaterialKind::kThinDielectric:
      return {};
    case MaterialKind::kHair:
      return EvaluateHairCos(m, wo, wi);
    case MaterialKind::kCoatedDiffuse:
    case MaterialKind::kCoatedConductor:
      return EvaluateCoatCos(m, wo, wi, random);
    case MaterialKind::kMeasured:
      return EvaluateMeasuredCos(*m.measured, wo, wi);
    case MaterialKind::kMix:
    case MaterialKind::kInterface:
      break;
  }
  LL_CHECK(false);
  return {};
}

std::optional<BsdfSample> SampleBsdf(const LocalMaterial& m, Vec3d wo, Random& random) {
  switch (m.kind) {
    case MaterialKind::kDiffuse:
    case MaterialKind::kDiffuseTransmission:
      return SampleTwoSidedDiffuse(m, wo, random);
    case MaterialKind::kConductor:
      return SampleConductor(m.interface, m.eta, m.k, wo, random);
    case MaterialKind::kDielectric:
      return SampleDielectric(m.interface, m.index, wo, random);
    case MaterialKind::kThinDielectric:
      return SampleThin(m.index, wo, random);
    case MaterialKind::kHair: {
      const Vec3d wi = Normalize(SampleBall(random));
      return BsdfSample{wi, EvaluateHairCos(m, wo, wi) * (4 * kPi), false};
    }
    case MaterialKind::kCoatedDiffuse:
    case MaterialKind::kCoatedConductor:
      return SampleCoat(m, wo, random);
    case MaterialKind::kMeasured:
      return SampleMeasured(*m.measured, wo, random);
    case MaterialKind::kMix:
    case MaterialKind::kInterface:
      break;
  }
  LL_CHECK(false);
  return std::nullopt;
}

}  // namespace lanelight::reference
