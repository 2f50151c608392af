#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/image/spectrum.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

constexpr double kHottest = 1e6;  // kelvin

// Calls `convert`; its InputErrors have no place and get that of the parameter.
template <typename Fn>
Rgb At(const ParamSet& params, const Param& param, const Fn& convert) {
  try {
    return convert();
  } catch (const InputError& error) {
    params.Fail(param, WithoutPrefix(error));
  }
}

Rgb RgbOf(const ParamSet& params, const Param& param, SpectrumUse use) {
  if (param.numbers.size() > 3) params.Fail(param, "more than one value");
  for (double value : param.numbers) {
    if (value < 0) params.Fail(param, "the component {} is negative", value);
    if (use == SpectrumUse::kAlbedo && value > 1) {
      params.Fail(param, "the component {} of a reflectance is above 1", value);
    }
  }
  const Rgb rgb = {param.numbers[0], param.numbers[1], param.numbers[2]};
  if (param.color_space == "srgb") return rgb;
  return At(params, param, [&] { return ToSrgb(param.color_space, rgb, use); });
}

Rgb BlackbodyOf(const ParamSet& params, const Param& param, SpectrumUse use) {
  const double kelvin = param.numbers[0];
  if (!(kelvin >= 100 && kelvin <= kHottest)) {
    params.Fail(param, "the temperature {} is outside 100 to {} kelvin", kelvin,
                kHottest);
  }
  if (use == SpectrumUse::kAlbedo || use == SpectrumUse::kUnbounded) {
    return RgbFromSpectrum(NormalizedBlackbody(kelvin), use);
  }
  if (use == SpectrumUse::kRadiance) return RgbOfBlackbody(kelvin) / kPhotometricIntegral;
  return RgbFromBlackbody(kelvin);
}

}  // namespace

Rgb ColorOf(ParseState& state, const ParamSet& params, const Param& param,
            SpectrumUse use) {
  Rgb color;
  if (param.type == ParamType::kRgb) {
    color = RgbOf(params, param, use);
  } else if (param.type == ParamType::kBlackbody) {
    color = BlackbodyOf(params, param, use);
  } else if (param.strings.empty() || !NamedSpectrum(param.strings[0], use, &color)) {
    const SpectrumSamples samples = SamplesOf(state, params, param);
    color = At(params, param,
               [&] { return RgbFromSamples(samples.wavelengths, samples.values, use); });
  }
  if (color.x < 0 || color.y < 0 || color.z < 0) {
    state.AddNote(param.where,
                  "colour outside the sRGB gamut: negative components become 0");
    color = Max(color, Rgb{});
  }
  // Outside of the sRGB gamut, a component can be above 1 beside one below 0.
  if (use == SpectrumUse::kAlbedo) color = Min(color, Rgb{1, 1, 1});
  return color;
}

OwnSpectrum SpectrumOf(const ParseState& state, const ParamSet& params,
                       const Param& param, SpectrumUse use) {
  if (param.type == ParamType::kRgb) return nullptr;
  const auto fraction = [](Spectrum spectrum) {
    return std::make_shared<const Spectrum>(std::move(spectrum));
  };
  const bool unbounded = use == SpectrumUse::kUnbounded;
  if (param.type == ParamType::kBlackbody) {
    const bool light = !unbounded && use != SpectrumUse::kAlbedo;
    const double kelvin = param.numbers[0];
    return fraction(light ? BlackbodySpectrum(kelvin) : NormalizedBlackbody(kelvin));
  }
  if (!param.strings.empty()) {
    if (const auto named = SpectrumOfName(param.strings[0])) return fraction(*named);
  }
  const SpectrumSamples samples = SamplesOf(state, params, param);
  return fraction(SpectrumFromSamples(samples.wavelengths, samples.values, unbounded));
}

Rgb PlainColor(ParseState& state, ParamSet& params, std::string_view name, Rgb absent,
               SpectrumUse use) {
  const Param* param =
      params.Find(name, {ParamType::kRgb, ParamType::kSpectrum, ParamType::kBlackbody});
  return param == nullptr ? absent : ColorOf(state, params, *param, use);
}

ColorValue TexturedColor(ParseState& state, ParamSet& params, std::string_view name,
                         Rgb absent, SpectrumUse use) {
  const Param* param = params.Find(name, kColorTypes);
  if (param == nullptr) return {absent, kNone};
  if (param->type != ParamType::kTexture) {
    return {ColorOf(state, params, *param, use), kNone,
            SpectrumOf(state, params, *param, use)};
  }
  return {absent, Resolve(state, {{NameKind::kSpectrumTexture, param->strings[0]},
                                  param->where})};
}

FloatValue TexturedFloat(ParseState& state, ParamSet& params, std::string_view name,
                         double absent, Limits limits) {
  const Param* param = params.Find(name, {ParamType::kFloat, ParamType::kTexture});
  if (param == nullptr) return {absent, kNone};
  if (param->type == ParamType::kFloat) return {params.Float(name, absent, limits)};
  return {absent,
          Resolve(state, {{NameKind::kFloatTexture, param->strings[0]}, param->where})};
}

}  // namespace lanelight
