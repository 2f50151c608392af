// Material "subsurface": a dielectric that contains a medium with random walks. pbrt-v4
// has a profile by photon beam diffusion instead (Habel, Christensen and Jarosz 2013).
#include <fmt/format.h>

#include <algorithm>

#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

// Throws if the file states the inside in two ways.
void Exclude(ParamSet& params, const Param* value_param, const char* name,
             const std::vector<const char*>& others) {
  for (const char* other : others) {
    if (value_param == nullptr || !params.Has(other)) continue;
    params.Fail(*value_param, "\"{}\" and \"{}\" exclude each other", name, other);
  }
}

void ReadNamed(ParamSet& params, const Param& name, Medium* inside) {
  Exclude(params, &name, "name", {"sigma_a", "sigma_s", "reflectance", "mfp"});
  const Coefficients& found = Lookup(ScatteringPresets(), name.strings.at(0), name.where,
                                     "named medium of a material:");
  inside->sigma_a = found.sigma_a, inside->sigma_s = found.sigma_s;
  if (inside->g == 0) return;
  inside->g = 0;
  params.Ignore("g", "the coefficients of a name are those for g = 0");
}

void ReadByReflectance(ParseState& state, ParamSet& params, Medium* inside) {
  const Param* value_param = params.Find("reflectance", {});
  Exclude(params, value_param, "reflectance", {"sigma_a", "sigma_s"});
  inside->by_reflectance = true;
  inside->reflectance =
      TexturedColor(state, params, "reflectance", {1, 1, 1}, SpectrumUse::kAlbedo);
  const Rgb mfp = PlainColor(state, params, "mfp", {1, 1, 1}, SpectrumUse::kUnbounded);
  const Param* mfp_param = params.Find("mfp", {});
  if (std::min({mfp.x, mfp.y, mfp.z}) <= 0 && mfp_param != nullptr) {
    params.Fail(*mfp_param, "a mean free path of 0 or less; it must be positive");
  }
  inside->sigma_a = {};
  inside->sigma_s = {1 / mfp.x, 1 / mfp.y, 1 / mfp.z};
}

// The defaults are those of whole milk. pbrt-v4 takes both coefficients or none.
void ReadOwnCoefficients(ParseState& state, ParamSet& params, Medium* inside) {
  const Coefficients& milk = ScatteringPresets().at("Wholemilk");
  const auto read = [&](const char* name, Rgb absent) {
    return PlainColor(state, params, name, absent, SpectrumUse::kUnbounded);
  };
  inside->sigma_a = read("sigma_a", milk.sigma_a);
  inside->sigma_s = read("sigma_s", milk.sigma_s);
  params.Ignore("mfp", "it goes with \"reflectance\"");
}

}  // namespace

Index InterpretInside(ParseState& state, ParamSet& params, double eta) {
  Medium inside;
  inside.name = "subsurface";
  inside.where = params.where();
  inside.in_material = true;
  inside.eta = eta;
  inside.g = params.Float("g", 0, {-0.9999, 0.9999});
  for (const char* name : {"sigma_a", "sigma_s", "mfp"}) {
    const Param* texture = params.Find(name, {});
    if (texture == nullptr || texture->type != ParamType::kTexture) continue;
    params.Fail(*texture,
                "a texture of \"{}\" is not supported: the medium in a material is the "
                "same everywhere, but for its \"reflectance\"",
                name);
  }
  double scale = params.Float("scale", 1, {1e-12, 1e12});
  if (const Param* name = params.Find("name", {ParamType::kString})) {
    ReadNamed(params, *name, &inside);
  } else if (params.Has("reflectance")) {
    ReadByReflectance(state, params, &inside);
    scale = 1 / scale;  // of the mean free path
  } else {
    ReadOwnCoefficients(state, params, &inside);
  }
  inside.sigma_a *= scale, inside.sigma_s *= scale;
  return Append(state.scene.media, std::move(inside));
}

}  // namespace lanelight
