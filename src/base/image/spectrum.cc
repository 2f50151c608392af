#include "src/base/image/spectrum.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/image/color_matrix.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/fluorescent_lamps.h"
#include "src/base/image/spectrum_data.h"
#include "src/base/image/spectrum_integral.h"

namespace lanelight {
namespace {

Rgb ClampZero(Rgb c) { return Max(c, Rgb{}); }

// Cut to the gamut first, so that the luminance is 1 after it.
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
    throw InputError(fmt::format(
        "a spectrum needs as many values as wavelengths, at least one; found {} "
        "wavelengths and {} values",
        nm.size(), values.size()));
  }
  for (std::size_t i = 0; i < nm.size(); ++i) {
    if (!std::isfinite(nm[i]) || !std::isfinite(values[i])) {
      throw InputError(fmt::format("sample {} of a spectrum is not finite", i + 1));
    }
    if (i > 0 && nm[i] <= nm[i - 1]) {
      throw InputError(
          fmt::format("the wavelengths of a spectrum must increase; found {} "
                      "after {}",
                      nm[i], nm[i - 1]));
    }
  }
}

// Reflectance at normal incidence from air.
double NormalReflectance(double eta, double k) {
  const double below = eta - 1, above = eta + 1;
  return (below * below + k * k) / (above * above + k * k);
}

// (eta, k) with this reflectance: keeps eta and solves for k; if eta alone already
// reflects more, k is 0 and eta gives way.
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

}  // namespace

// Planck's law, up to a factor that keeps it in range at any temperature.
Spectrum BlackbodySpectrum(double kelvin) {
  constexpr double kSecondConstant = 1.438776877e7;  // h c / k, in nm K
  return [kelvin](double nm) {
    const double x = kSecondConstant / (nm * kelvin);
    const double least = kSecondConstant / (kLastNm * kelvin);
    return std::pow(nm / 560, -5) * std::exp(least - x) / -std::expm1(-x);
  };
}

Spectrum SpectrumFromSamples(const std::vector<double>& wavelengths_nm,
                             const std::vector<double>& values, bool extend) {
  CheckSamples(wavelengths_nm, values);
  return Interpolated(wavelengths_nm, values, extend);
}

std::optional<Spectrum> SpectrumOfName(const std::string& name) {
  for (const NamedLight& light : NamedLights()) {
    if (name == light.name) return light.spectrum;
  }
  for (const GlassIndex& glass : kGlasses) {
    if (name == glass.name) {
      return [&glass](double nm) { return GlassIndexAt(glass, nm); };
    }
  }
  for (const MetalTable& table : kMetals) {
    const auto is = [&](const char* which) {
      return name == fmt::format("metal-{}-{}", table.name, which);
    };
    if (is("eta")) return MetalSpectrum(table.eta);
    if (is("k")) return MetalSpectrum(table.k);
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
  for (const MetalTable& table : kMetals) {
    if (metal != table.name) continue;
    *ior = MatchReflectance(MetalSpectrum(table.eta), MetalSpectrum(table.k));
    return true;
  }
  return false;
}

ComplexIor ComplexIorFromSamples(const std::vector<double>& eta_nm,
                                 const std::vector<double>& eta,
                                 const std::vector<double>& k_nm,
                                 const std::vector<double>& k) {
  return MatchReflectance(SpectrumFromSamples(eta_nm, eta, true),
                          SpectrumFromSamples(k_nm, k, true));
}

bool NamedGlassEta(const std::string& name, double* eta) {
  for (const GlassIndex& glass : kGlasses) {
    if (name != glass.name) continue;
    *eta = glass.eta;
    return true;
  }
  return false;
}

bool NamedSpectrum(const std::string& name, SpectrumUse use, Rgb* rgb) {
  for (const NamedLight& light : NamedLights()) {
    if (name != light.name) continue;
    const bool emits = use == SpectrumUse::kRadiance;
    *rgb = Convert(light.spectrum, emits ? SpectrumUse::kIlluminant : use);
    return true;
  }
  double glass;
  if (NamedGlassEta(name, &glass)) {
    *rgb = Convert([glass](double) { return glass; }, use);
    return true;
  }
  for (const MetalTable& table : kMetals) {
    const bool is_eta = name == fmt::format("metal-{}-eta", table.name);
    if (!is_eta && name != fmt::format("metal-{}-k", table.name)) continue;
    if (use == SpectrumUse::kUnbounded) {
      ComplexIor ior;
      NamedMetal(table.name, &ior);
      *rgb = is_eta ? ior.eta : ior.k;
    } else {
      *rgb = Convert(MetalSpectrum(is_eta ? table.eta : table.k), use);
    }
    return true;
  }
  return false;
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
