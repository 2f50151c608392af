#include "src/base/image/spectrum.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/fluorescent_lamps.h"
#include "src/base/image/spectrum_data.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {
namespace {

Rgb ClampZero(Rgb c) { return Max(c, Rgb{}); }

// Clamps to the gamut first, so that the luminance is 1 afterwards.
Rgb NormalizedLight(const Spectrum& light) {
  const Rgb color = ClampZero(ColorOfLight(light));
  const double y = Luminance(color);
  if (!(y > 0)) throw InputError("an illuminant must emit between 360 and 830 nm");
  return color / y;
}

Rgb Convert(const Spectrum& spectrum, SpectrumUse use) {
  if (use == SpectrumUse::kIlluminant) return NormalizedLight(spectrum);
  if (use == SpectrumUse::kRadiance) {
    const double unit = Luminance(ColorOfLight([](double) { return 1.0; }));
    return NormalizedLight(spectrum) * (Luminance(ColorOfLight(spectrum)) / unit);
  }
  const Rgb color = ClampZero(ColorUnderD65(spectrum));
  return use == SpectrumUse::kAlbedo ? Min(color, Rgb{1, 1, 1}) : color;
}

void CheckSamples(const std::vector<double>& nm, const std::vector<double>& values) {
  if (nm.empty() || nm.size() != values.size()) {
    throw InputError(
        "a spectrum needs as many values as wavelengths, at least one; found {} "
        "wavelengths and {} values",
        nm.size(), values.size());
  }
  for (std::size_t i = 0; i < nm.size(); ++i) {
    if (!std::isfinite(nm[i]) || !std::isfinite(values[i])) {
      throw InputError("sample {} of a spectrum is not finite", i + 1);
    }
    if (i > 0 && nm[i] <= nm[i - 1]) {
      throw InputError("the wavelengths of a spectrum must increase; found {} after {}",
                       nm[i], nm[i - 1]);
    }
  }
}

double NormalReflectance(double eta, double k) {
  const double below = eta - 1, above = eta + 1;
  return (below * below + k * k) / (above * above + k * k);
}

// Finds (eta, k) of this reflectance: keeps eta and solves for k; if eta alone reflects
// more, k becomes 0 and eta changes.
void SolveChannel(double reflectance, double* eta, double* k) {
  const double r = std::clamp(reflectance, 0.0, 0.9995);
  const double below = *eta - 1, above = *eta + 1;
  const double k2 = (r * above * above - below * below) / (1 - r);
  *k = std::sqrt(std::max(0.0, k2));
  if (k2 >= 0) return;
  const double root = std::sqrt(r);
  *eta = *eta >= 1 ? (1 + root) / (1 - root) : (1 - root) / (1 + root);
}

ComplexIor MatchReflectance(const Spectrum& eta, const Spectrum& k) {
  const Rgb reflectance =
      ColorUnderD65([&](double nm) { return NormalReflectance(eta(nm), k(nm)); });
  ComplexIor ior{SensitivityMean(eta), {}};
  for (int c = 0; c < 3; ++c) SolveChannel(reflectance[c], &ior.eta[c], &ior.k[c]);
  return ior;
}

Spectrum MetalSpectrum(const std::array<double, kMetalSamples>& samples) {
  return EvenlySpaced({samples.begin(), samples.end()}, kMetalStart, kMetalStep, true);
}

struct NamedLight {
  const char* name;
  Spectrum spectrum;
};

const std::vector<NamedLight>& NamedLights() {
  static const std::vector<NamedLight> lights = [] {
    std::vector<NamedLight> all = {
        {"illum-acesD60", Daylight(0.32168, 0.33767)},
        // CIE 15:2004: a black body of 2848 K by the constants of 1931, 2856 K today.
        {"stdillum-A", BlackbodySpectrum(2848 * 1.4388 / 1.4350)},
        {"stdillum-D50", Daylight(0.34567, 0.35850)},
        {"stdillum-D65", DaylightD65()},
    };
    for (const FluorescentLamp& lamp : kFluorescentLamps) {
      all.push_back({lamp.name, EvenlySpaced({lamp.power.begin(), lamp.power.end()},
                                             kLampStart, kLampStep, false)});
    }
    return all;
  }();
  return lights;
}

// Sellmeier's formula, wavelengths in micrometres.
double GlassIndexAt(const GlassIndex& glass, double nm) {
  const double square = nm * nm * 1e-6;
  double sum = 1;
  for (int i = 0; i < 3; ++i) sum += glass.b[i] * square / (square - glass.c[i]);
  return std::sqrt(sum);
}

// Returns the entry of this name, or null.
template <class Table>
auto Find(const Table& table, const std::string& name) {
  const auto found = std::find_if(std::begin(table), std::end(table),
                                  [&](const auto& entry) { return name == entry.name; });
  return found == std::end(table) ? nullptr : &*found;
}

// Eta or k of a metal.
struct MetalPart {
  const MetalTable* table = nullptr;
  bool is_eta = false;

  lanelight::Spectrum Spectrum() const {
    return MetalSpectrum(is_eta ? table->eta : table->k);
  }
};

// Finds a spectrum such as "metal-Cu-eta"; a null table for other names.
MetalPart FindMetalPart(const std::string& name) {
  for (const MetalTable& table : kMetals) {
    if (name == fmt::format("metal-{}-eta", table.name)) return {&table, true};
    if (name == fmt::format("metal-{}-k", table.name)) return {&table, false};
  }
  return {};
}

}  // namespace

// Planck's law, up to a factor that keeps it in range at any temperature.
Spectrum BlackbodySpectrum(double kelvin) {
  constexpr double kSecondConstant = 1.438776877e7;  // h c / k, in nm K
  return [kelvin](double nm) {
    const double x = kSecondConstant / (nm * kelvin);
    const double min_exponent = kSecondConstant / (kLastNm * kelvin);
    return std::pow(nm / 560, -5) * std::exp(min_exponent - x) / -std::expm1(-x);
  };
}

Spectrum SpectrumFromSamples(const std::vector<double>& wavelengths_nm,
                             const std::vector<double>& values, bool extend) {
  CheckSamples(wavelengths_nm, values);
  return Interpolated(wavelengths_nm, values, extend);
}

std::optional<Spectrum> SpectrumOfName(const std::string& name) {
  if (const NamedLight* light = Find(NamedLights(), name)) return light->spectrum;
  if (const GlassIndex* glass = Find(kGlasses, name)) {
    return [glass](double nm) { return GlassIndexAt(*glass, nm); };
  }
  if (const MetalPart part = FindMetalPart(name); part.table != nullptr) {
    return part.Spectrum();
  }
  return std::nullopt;
}

Rgb RgbFromBlackbody(double kelvin) {
  LL_CHECK_GT(kelvin, 0);
  LL_CHECK(std::isfinite(kelvin));
  return NormalizedLight(BlackbodySpectrum(kelvin));
}

Rgb RgbFromSpectrum(const Spectrum& spectrum, SpectrumUse use) {
  return Convert(spectrum, use);
}

Rgb RgbFromSamples(const std::vector<double>& wavelengths_nm,
                   const std::vector<double>& values, SpectrumUse use) {
  return Convert(SpectrumFromSamples(wavelengths_nm, values, false), use);
}

bool NamedMetal(const std::string& metal, ComplexIor* ior) {
  const MetalTable* table = Find(kMetals, metal);
  if (table == nullptr) return false;
  *ior = MatchReflectance(MetalSpectrum(table->eta), MetalSpectrum(table->k));
  return true;
}

ComplexIor ComplexIorFromSamples(const std::vector<double>& eta_nm,
                                 const std::vector<double>& eta,
                                 const std::vector<double>& k_nm,
                                 const std::vector<double>& k) {
  return MatchReflectance(SpectrumFromSamples(eta_nm, eta, true),
                          SpectrumFromSamples(k_nm, k, true));
}

bool NamedGlassEta(const std::string& name, double* eta) {
  const GlassIndex* glass = Find(kGlasses, name);
  if (glass != nullptr) *eta = glass->eta;
  return glass != nullptr;
}

bool NamedSpectrum(const std::string& name, SpectrumUse use, Rgb* rgb) {
  const MetalPart metal = FindMetalPart(name);
  double glass;
  if (const NamedLight* light = Find(NamedLights(), name)) {
    const bool emits = use == SpectrumUse::kRadiance;
    *rgb = Convert(light->spectrum, emits ? SpectrumUse::kIlluminant : use);
  } else if (NamedGlassEta(name, &glass)) {
    *rgb = Convert([glass](double) { return glass; }, use);
  } else if (metal.table != nullptr && use == SpectrumUse::kUnbounded) {
    ComplexIor ior;
    NamedMetal(metal.table->name, &ior);
    *rgb = metal.is_eta ? ior.eta : ior.k;
  } else if (metal.table != nullptr) {
    *rgb = Convert(metal.Spectrum(), use);
  } else {
    return false;
  }
  return true;
}

std::vector<std::string> NamedSpectra() {
  std::vector<std::string> names;
  for (const NamedLight& light : NamedLights()) names.push_back(light.name);
  for (const GlassIndex& glass : kGlasses) names.push_back(glass.name);
  for (const MetalTable& table : kMetals) {
    names.push_back(fmt::format("metal-{}-eta", table.name));
    names.push_back(fmt::format("metal-{}-k", table.name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

Rgb ToSrgb(const std::string& color_space, Rgb color, SpectrumUse use) {
  if (color_space == "srgb") return color;
  const ColorMatrix srgb = SrgbFrom(FindColorSpace(color_space));
  const Rgb raw = srgb * color;
  if (use == SpectrumUse::kIlluminant || use == SpectrumUse::kRadiance) return raw;
  const Rgb white = srgb * Rgb{1, 1, 1};
  return {raw.x / white.x, raw.y / white.y, raw.z / white.z};
}

}  // namespace lanelight
