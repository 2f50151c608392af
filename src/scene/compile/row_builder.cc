#include "src/scene/compile/materials.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/image/upsampling.h"

namespace lanelight {
namespace {

// pbrt-v4: below this a microfacet surface is a smooth one.
constexpr double kSmoothAlpha = 1e-3;
// Reflectance of a metal that is given as a colour: k of 1 would be infinite.
constexpr double kMaxMetalReflectance = 0.9999;
constexpr double kMinHairRoughness = 0.01;

bool IsTextured(const ColorValue& v) { return v.texture != kNone; }
bool IsTextured(const FloatValue& v) { return v.texture != kNone; }

bool IsSmooth(const MaterialRow& row) {
  return !IsTextured(row.alpha_x) && !IsTextured(row.alpha_y) &&
         std::max(row.alpha_x.constant, row.alpha_y.constant) < kSmoothAlpha;
}

Rgb Clamped(Rgb c, double largest) {
  const Rgb zero, top = {largest, largest, largest};
  return Min(Max(c, zero), top);
}

void CheckEta(const Material& m) {
  if (m.interface_eta > 0 && std::isfinite(m.interface_eta)) return;
  ThrowUnsupportedMaterial(
      m, fmt::format("index of refraction {}; it must be positive", m.interface_eta));
}

// Returns a spectrum with `change` applied to every value.
template <class Change>
OwnSpectrum Changed(const OwnSpectrum& spectrum, const Change& change) {
  if (spectrum == nullptr) return nullptr;
  return std::make_shared<const Spectrum>(
      [spectrum, change](double nm) { return change((*spectrum)(nm)); });
}

// Returns alpha under Integrator::regularize.
double RegularAlpha(double alpha) {
  return alpha < 0.3 ? std::clamp(2 * alpha, 0.1, 0.3) : alpha;
}

// Returns the extinction of a metal of index 1 with reflectance r at normal incidence.
double Extinction(double r) {
  const double below = std::clamp(r, 0.0, kMaxMetalReflectance);
  return 2 * std::sqrt(below / (1 - below));
}

}  // namespace

void ThrowUnsupportedMaterial(const Material& m, const std::string& what) {
  throw InputError(m.where,
                   (m.name.empty() ? "" : "material \"" + m.name + "\": ") + what);
}

// As in pbrt, constant reflectances are clamped too.
ColorValue RowBuilder::Reflectance(const ColorValue& v) const {
  ColorValue color = Color(v);
  if (!IsTextured(color)) color.constant = Clamped(color.constant, 1);
  return color;
}

// Scaled and then clamped, at each wavelength where paths carry those (as pbrt-v4).
// Textures are scaled there too, by MaterialRow::color_scale.
ColorValue RowBuilder::ScaledReflectance(const ColorValue& v, double scale) {
  const bool spectral = d_.integrator.transport == Transport::kSpectral;
  const ColorValue color = Color(v);
  if (scale == 1) return Reflectance(v);
  if (IsTextured(color)) {
    return spectral ? color : Derived(TextureKind::kScale, color, scale);
  }
  ColorValue scaled = {Clamped(color.constant * scale, 1), kNone};
  if (!spectral) return scaled;
  const OwnSpectrum own =
      color.spectrum != nullptr
          ? color.spectrum
          : std::make_shared<const Spectrum>(UpsampledReflectance(color.constant));
  scaled.spectrum = Changed(own, [=](double r) { return std::min(r * scale, 1.0); });
  return scaled;
}

// Returns whether the medium in a coat does more than absorb.
bool RowBuilder::Scatters(const Material& coat) const {
  const ColorValue albedo = Reflectance(coat.coat_albedo);
  return IsTextured(albedo) || albedo.constant != Rgb{};
}

// Returns the texture of the inside at the point of entry; white if there is none.
ColorValue RowBuilder::Inside(const Material& m) const {
  const Medium& inside = d_.media[static_cast<std::size_t>(m.inside)];
  const ColorValue reflectance = Color(inside.reflectance);
  if (inside.by_reflectance && IsTextured(reflectance)) return reflectance;
  return {{1, 1, 1}, kNone};
}

void RowBuilder::Diffuse(const Material& m, MaterialRow& row) {
  constexpr ShadeKind kKinds[] = {ShadeKind::kDiffuse, ShadeKind::kDiffuseUniform,
                                  ShadeKind::kDiffuseInSphere};  // by Scattering
  row.kind = kKinds[static_cast<int>(options_.scattering.value_or(m.scattering))];
  row.color0 = Reflectance(m.reflectance);
}

// Sets index and extinction relative to `eta_above`.
void RowBuilder::Metal(const Material& m, double eta_above, MaterialRow& row) {
  row.by_reflectance = m.has_reflectance;
  if (m.has_reflectance) {
    const ColorValue reflectance = Color(m.reflectance);
    row.color0 = {Rgb{1, 1, 1} / eta_above, kNone};
    if (IsTextured(reflectance)) {
      row.color1 = Derived(TextureKind::kMetalExtinction, reflectance, 1 / eta_above);
      return;
    }
    const Rgb r = Clamped(reflectance.constant, kMaxMetalReflectance);
    row.color1 = {Rgb{Extinction(r.x), Extinction(r.y), Extinction(r.z)} / eta_above,
                  kNone};
    if (d_.integrator.transport != Transport::kSpectral) return;
    const OwnSpectrum own =
        reflectance.spectrum != nullptr
            ? reflectance.spectrum
            : std::make_shared<const Spectrum>(UpsampledReflectance(r));
    row.color1.spectrum =
        Changed(own, [=](double v) { return Extinction(v) / eta_above; });
  } else {
    row.color0 = Scaled(Color(m.eta), 1 / eta_above);
    row.color1 = Scaled(Color(m.k), 1 / eta_above);
  }
}

ColorValue RowBuilder::Derived(TextureKind kind, const ColorValue& from, double amount) {
  Texture texture;
  texture.kind = kind;
  texture.name = d_.textures[static_cast<std::size_t>(from.texture)].name;
  texture.where = d_.textures[static_cast<std::size_t>(from.texture)].where;
  texture.tex1 = from;
  texture.amount.constant = amount;
  derived_.push_back(std::move(texture));
  return {{}, static_cast<Index>(d_.textures.size() + derived_.size()) - 1};
}

ColorValue RowBuilder::Scaled(const ColorValue& value, double scale) {
  if (!IsTextured(value)) {
    return {value.constant * scale, kNone,
            Changed(value.spectrum, [=](double v) { return v * scale; })};
  }
  return scale == 1 ? value : Derived(TextureKind::kScale, value, scale);
}

FloatValue RowBuilder::Alpha(const FloatValue& v, bool remap) {
  FloatValue alpha = constants_.Fold(v);
  if (!IsTextured(alpha)) {
    alpha.constant = AlphaOfRoughness(alpha.constant, remap);
    if (regular_) alpha.constant = RegularAlpha(alpha.constant);
  } else if (regular_) {
    const ColorValue roughness = {{}, alpha.texture};
    alpha.texture = Derived(TextureKind::kRegularAlpha, roughness, remap ? 1 : 0).texture;
  }
  return alpha;
}

MaterialRow RowBuilder::RegularRowOf(const Material& m) {
  regular_ = true;
  MaterialRow row = RowOf(m);
  regular_ = false;
  return row;
}

void RowBuilder::Interface(const Material& m, MaterialRow& row) {
  row.alpha_x = Alpha(m.uroughness, m.remap_roughness);
  row.alpha_y = Alpha(m.vroughness, m.remap_roughness);
  row.remap = m.remap_roughness && !regular_;
  row.eta = m.interface_eta;
}

void RowBuilder::CoatOf(const Material& m, MaterialRow& row) {
  CheckEta(m);
  Interface(m, row);
  // Equal indices on both sides: nothing to see, whatever the roughness.
  if (Scatters(m) && row.eta == 1) row.alpha_x = row.alpha_y = {};
  if (Scatters(m)) {
    row.coat_g = constants_.Fold(m.coat_g);
    row.coat_albedo = Reflectance(m.coat_albedo);
  }
  row.coat_thickness = constants_.Fold(FloatValue{m.thickness, m.thickness_texture});
  Coat coat = {std::nullopt, m.interface_eta, std::nullopt};
  if (IsSmooth(row)) {
    coat.alpha = 0;
  } else if (!IsTextured(row.alpha_x) && !IsTextured(row.alpha_y)) {
    coat.alpha = std::sqrt(std::max(row.alpha_x.constant, kMinAlpha) *
                           std::max(row.alpha_y.constant, kMinAlpha));
  }
  if (!IsTextured(row.coat_thickness)) coat.thickness = row.coat_thickness.constant;
  const auto next = static_cast<std::int32_t>(coats_.size());
  row.coat = coats_.try_emplace(coat, next).first->second;
  row.coat_depth = static_cast<std::uint32_t>(m.coat_max_depth);
}

// Absorption becomes the reflectance that gives it (HairBsdf::AbsorptionOf), which is
// what textures, guides of denoisers and overrides of materials know.
void RowBuilder::Hair(const Material& m, MaterialRow& row) {
  CheckEta(m);
  row.kind = ShadeKind::kHair;
  row.eta = m.interface_eta;
  row.alpha_x.constant = std::max(m.beta_m, kMinHairRoughness);
  row.alpha_y.constant = std::max(m.beta_n, kMinHairRoughness);
  row.alpha2_x.constant = m.tilt / 180 * std::numbers::pi;
  row.color0 = Reflectance(m.reflectance);
  if (m.has_reflectance) return;
  const double n = row.alpha_y.constant;
  const double k =
      5.969 + n * (-0.215 + n * (2.532 + n * (-10.73 + n * (5.574 + n * 0.245))));
  const auto reflected = [k](double absorption) {
    return std::exp(-k * std::sqrt(std::max(absorption, 0.0)));
  };
  for (int c = 0; c < 3; ++c) row.color0.constant[c] = reflected(m.sigma_a[c]);
  if (d_.integrator.transport != Transport::kSpectral) return;
  const OwnSpectrum own =
      m.sigma_a_spectrum != nullptr
          ? m.sigma_a_spectrum
          : std::make_shared<const Spectrum>(UpsampledColor(m.sigma_a));
  row.color0.spectrum = Changed(own, reflected);
}

MaterialRow RowBuilder::RowOf(const Material& m) {
  MaterialRow row;
  switch (m.kind) {
    case MaterialKind::kDiffuse:
      Diffuse(m, row);
      break;
    case MaterialKind::kConductor:
      Interface(m, row);
      row.eta = 1;
      Metal(m, 1, row);
      row.kind = IsSmooth(row) ? ShadeKind::kConductorSmooth : ShadeKind::kConductorRough;
      break;
    case MaterialKind::kDielectric:
      CheckEta(m);
      Interface(m, row);
      row.dispersion = m.dispersion;
      if (m.inside != kNone) row.color0 = Inside(m);
      // Equal indices on both sides: nothing to see, whatever the roughness (as pbrt).
      row.kind = IsSmooth(row) || row.eta == 1 ? ShadeKind::kDielectricSmooth
                                               : ShadeKind::kDielectricRough;
      break;
    case MaterialKind::kThinDielectric:
      CheckEta(m);
      row.eta = m.interface_eta;
      row.dispersion = m.dispersion;
      row.kind = ShadeKind::kThinDielectric;
      break;
    case MaterialKind::kCoatedDiffuse:
      CoatOf(m, row);
      row.color0 = Reflectance(m.reflectance);
      if (Scatters(m)) {
        row.kind = ShadeKind::kCoatedDiffuseMedium;
        break;
      }
      row.kind = IsSmooth(row) ? ShadeKind::kCoatedDiffuseSmooth
                               : ShadeKind::kCoatedDiffuseRough;
      break;
    case MaterialKind::kCoatedConductor: {
      CoatOf(m, row);
      Metal(m, m.interface_eta, row);
      row.alpha2_x = Alpha(m.conductor_uroughness, m.remap_roughness);
      row.alpha2_y = Alpha(m.conductor_vroughness, m.remap_roughness);
      row.kind = ShadeKind::kCoatedConductor;
      if (Scatters(m)) row.kind = ShadeKind::kCoatedConductorMedium;
      break;
    }
    case MaterialKind::kDiffuseTransmission:
      row.color0 = ScaledReflectance(m.reflectance, m.scale);
      row.color1 = ScaledReflectance(m.transmittance, m.scale);
      row.color_scale = m.scale;
      row.kind = ShadeKind::kDiffuseTransmission;
      break;
    case MaterialKind::kMeasured:
      row.measured = m.measured;
      row.color0 = {HeadOnAlbedo(*m.measured), kNone};
      row.kind = ShadeKind::kMeasured;
      break;
    case MaterialKind::kHair:
      Hair(m, row);
      break;
    case MaterialKind::kInterface:
      row.kind = ShadeKind::kInterface;
      break;
    case MaterialKind::kMix:
      LL_CHECK(!"mixes have no row of this form");
  }
  return row;
}

}  // namespace lanelight
