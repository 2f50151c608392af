#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "src/base/core/suggest.h"
#include "src/base/image/upsampling.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

constexpr double kSodium = 587.6;  // nm, the helium d line, where catalogues state eta

const std::vector<std::string> kMetals = {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"};

SpectrumSamples PairUp(const ParamSet& params, const Param& param,
                       const std::vector<double>& numbers) {
  if (numbers.empty() || numbers.size() % 2 != 0) {
    params.Fail(param, "{} numbers; a spectrum is pairs of wavelength (nm) and value",
                numbers.size());
  }
  SpectrumSamples samples;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (numbers[i] <= 0 || (i > 0 && numbers[i] <= numbers[i - 2])) {
      params.Fail(param,
                  "wavelength {} (number {}): wavelengths must be positive and increase",
                  numbers[i], i + 1);
    }
    if (numbers[i + 1] < 0) {
      params.Fail(param, "the value {} at {} nm is negative", numbers[i + 1], numbers[i]);
    }
    samples.wavelengths.push_back(numbers[i]);
    samples.values.push_back(numbers[i + 1]);
  }
  return samples;
}

// "metal-Cu-eta" with suffix "-eta" gives "Cu"; "" if the name is not of that form.
std::string MetalName(const Param* param, const std::string& suffix) {
  if (param == nullptr) return "Cu";
  if (param->strings.empty() || param->type != ParamType::kSpectrum) return "";
  const std::string& name = param->strings[0];
  constexpr std::string_view kPrefix = "metal-";
  if (!name.starts_with(kPrefix) || !name.ends_with(suffix)) return "";
  return name.substr(kPrefix.size(), name.size() - kPrefix.size() - suffix.size());
}

ComplexIor Metal(const ParamSet& params, const Param* param, const std::string& metal) {
  ComplexIor ior;
  if (!NamedMetal(metal, &ior)) {
    ThrowUnknown(param == nullptr ? params.where() : param->where, "metal", metal,
                 kMetals);
  }
  return ior;
}

bool IsNamed(const Param& param) {
  Rgb unused;
  return !param.strings.empty() &&
         NamedSpectrum(param.strings[0], SpectrumUse::kUnbounded, &unused);
}

bool IsSampled(const Param* param) {
  return param != nullptr && param->type == ParamType::kSpectrum && !IsNamed(*param);
}

bool IsGrey(const Param& param) {
  const std::vector<double>& n = param.numbers;
  return param.type == ParamType::kRgb && n[0] == n[1] && n[1] == n[2];
}

OwnSpectrum IndexOf(ParseState& state, const ParamSet& params, const Param& param) {
  if (param.type == ParamType::kRgb) {
    return std::make_shared<const Spectrum>(
        UpsampledColor(ColorOf(state, params, param, SpectrumUse::kUnbounded)));
  }
  double glass = 0;
  const bool named = IsNamed(param);
  if (named && !NamedGlassEta(param.strings[0], &glass) &&
      !param.strings[0].starts_with("metal-")) {
    params.Fail(param, "the spectrum {} is that of a light", Quoted(param.strings[0]));
  }
  if (!named) ColorOf(state, params, param, SpectrumUse::kUnbounded);  // checks it
  return SpectrumOf(state, params, param, SpectrumUse::kUnbounded);
}

}  // namespace

SpectrumSamples SamplesOf(const ParseState& state, const ParamSet& params,
                          const Param& param) {
  if (param.strings.empty()) return PairUp(params, param, param.numbers);
  const std::string& name = param.strings[0];
  const std::string path = ResolvePath(state, name);
  const bool looks_like_file = name.find_first_of("./") != name.npos;
  std::error_code ignored;
  if (!looks_like_file &&
      !(state.options.allow_files && std::filesystem::exists(path, ignored))) {
    ThrowUnknown(param.where, "spectrum (and there is no such file):", name,
                 NamedSpectra());
  }
  return PairUp(params, param,
                ReadNumberFile(state, path, param.where, "the spectrum file"));
}

double DielectricEta(ParseState& state, ParamSet& params, std::string_view name,
                     double absent, OwnSpectrum* dispersion) {
  constexpr double kLow = 0.01, kHigh = 100;
  const Param* param = params.Find(name, {ParamType::kFloat, ParamType::kSpectrum,
                                          ParamType::kRgb, ParamType::kBlackbody});
  if (param == nullptr) return absent;
  if (param->type == ParamType::kFloat) return params.Float(name, absent, {kLow, kHigh});
  const OwnSpectrum spectrum = IndexOf(state, params, *param);
  double eta = (*spectrum)(kSodium);
  if (!param->strings.empty()) NamedGlassEta(param->strings[0], &eta);
  if (!(eta >= kLow && eta <= kHigh)) {
    params.Fail(*param, "the index of refraction {} is outside {} to {}", eta, kLow,
                kHigh);
  }
  if (IsGrey(*param)) return eta;
  if (dispersion != nullptr) {
    *dispersion = spectrum;
    return eta;
  }
  state.AddNoteOnce(
      param->where,
      fmt::format("dispersion of this material is not modelled: eta is taken at {} nm",
                  kSodium));
  return eta;
}

void ConductorIor(ParseState& state, ParamSet& params, const std::string& prefix,
                  ColorValue* eta, ColorValue* k) {
  const auto types = {ParamType::kSpectrum, ParamType::kRgb, ParamType::kTexture,
                      ParamType::kBlackbody};
  const Param* eta_param = params.Find(prefix + "eta", types);
  const Param* k_param = params.Find(prefix + "k", types);
  if (IsSampled(eta_param) && IsSampled(k_param)) {
    const SpectrumSamples n = SamplesOf(state, params, *eta_param);
    const SpectrumSamples m = SamplesOf(state, params, *k_param);
    const ComplexIor ior =
        ComplexIorFromSamples(n.wavelengths, n.values, m.wavelengths, m.values);
    *eta = {ior.eta, kNone,
            SpectrumOf(state, params, *eta_param, SpectrumUse::kUnbounded)};
    *k = {ior.k, kNone, SpectrumOf(state, params, *k_param, SpectrumUse::kUnbounded)};
    return;
  }
  const std::string eta_metal = MetalName(eta_param, "-eta");
  const std::string k_metal = MetalName(k_param, "-k");
  const auto value = [&](const std::string& name) {
    return TexturedColor(state, params, name, {}, SpectrumUse::kUnbounded);
  };
  const auto of_metal = [](Rgb color, const std::string& name) {
    return ColorValue{color, kNone,
                      std::make_shared<const Spectrum>(*SpectrumOfName(name))};
  };
  *eta = eta_metal.empty() ? value(prefix + "eta")
                           : of_metal(Metal(params, eta_param, eta_metal).eta,
                                      fmt::format("metal-{}-eta", eta_metal));
  *k = k_metal.empty() ? value(prefix + "k")
                       : of_metal(Metal(params, k_param, k_metal).k,
                                  fmt::format("metal-{}-k", k_metal));
}

}  // namespace lanelight
