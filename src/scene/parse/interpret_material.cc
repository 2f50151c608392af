#include <fmt/format.h>

#include <map>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/image/measured_reflectance.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

constexpr double kRoughest = 1e4;  // of roughness parameters; alpha above 1 is legal

// `<prefix>roughness` for both directions, `<prefix>uroughness`, `<prefix>vroughness`.
void ReadRoughness(ParseState& state, ParamSet& params, const std::string& prefix,
                   FloatValue* u, FloatValue* v) {
  const auto read = [&](const char* name, FloatValue absent) {
    const FloatValue value =
        TexturedFloat(state, params, prefix + name, absent.constant, {0, kRoughest});
    return params.Has(prefix + name) ? value : absent;
  };
  const FloatValue both = read("roughness", {0, kNone});
  *u = read("uroughness", both);
  *v = read("vroughness", both);
}

// Reads the roughness of the outermost surface.
void ReadOwnRoughness(ParseState& state, ParamSet& params, const std::string& prefix,
                      Material* material) {
  ReadRoughness(state, params, prefix, &material->uroughness, &material->vroughness);
  material->remap_roughness = params.Bool("remaproughness", true);
}

void ReadReflectance(ParseState& state, ParamSet& params, Material* material) {
  material->reflectance =
      TexturedColor(state, params, "reflectance", {0.5, 0.5, 0.5}, SpectrumUse::kAlbedo);
}

void ReadDiffuse(ParseState& state, ParamSet& params, Material* material) {
  ReadReflectance(state, params, material);
  material->scattering =
      params.Choice<Scattering>("scattering", {{"lambertian", Scattering::kLambertian},
                                               {"uniform", Scattering::kUniform},
                                               {"insphere", Scattering::kInSphere}});
}

// `reflectance`, or else `<prefix>eta` and `<prefix>k`.
void ReadMetal(ParseState& state, ParamSet& params, const std::string& prefix,
               Material* material) {
  const Param* reflectance = params.Find("reflectance", kColorTypes);
  material->has_reflectance = reflectance != nullptr;
  if (reflectance == nullptr) {
    return ConductorIor(state, params, prefix, &material->eta, &material->k);
  }
  if (params.Has(prefix + "eta") || params.Has(prefix + "k")) {
    params.Fail(*reflectance, "reflectance excludes {0}eta and {0}k", prefix);
  }
  ReadReflectance(state, params, material);
}

void ReadConductor(ParseState& state, ParamSet& params, Material* material) {
  ReadMetal(state, params, "", material);
  ReadOwnRoughness(state, params, "", material);
}

void ReadThinDielectric(ParseState& state, ParamSet& params, Material* material) {
  material->interface_eta =
      DielectricEta(state, params, "eta", 1.5, &material->dispersion);
}

void ReadDielectric(ParseState& state, ParamSet& params, Material* material) {
  ReadThinDielectric(state, params, material);
  ReadOwnRoughness(state, params, "", material);
}

// Reads what coateddiffuse and coatedconductor share.
void ReadCoat(ParseState& state, ParamSet& params, const std::string& prefix,
              Material* material) {
  material->interface_eta = DielectricEta(state, params, prefix + "eta", 1.5);
  ReadOwnRoughness(state, params, prefix, material);
  const FloatValue thickness = TexturedFloat(state, params, "thickness", 0.01, {0, 1e6});
  material->thickness = thickness.constant;
  material->thickness_texture = thickness.texture;
  material->coat_g = TexturedFloat(state, params, "g", 0, {-0.9999, 0.9999});
  material->coat_albedo =
      TexturedColor(state, params, "albedo", {0, 0, 0}, SpectrumUse::kAlbedo);
  material->coat_max_depth = params.Integer("maxdepth", 10, {1, 10000});
  params.Ignore(
      "nsamples",
      "each path takes one random walk; increase the samples per pixel instead");
}

void ReadCoatedDiffuse(ParseState& state, ParamSet& params, Material* material) {
  ReadCoat(state, params, "", material);
  ReadReflectance(state, params, material);
}

void ReadCoatedConductor(ParseState& state, ParamSet& params, Material* material) {
  ReadCoat(state, params, "interface.", material);
  ReadMetal(state, params, "conductor.", material);
  ReadRoughness(state, params, "conductor.", &material->conductor_uroughness,
                &material->conductor_vroughness);
}

void ReadDiffuseTransmission(ParseState& state, ParamSet& params, Material* material) {
  const Rgb quarter = {0.25, 0.25, 0.25};
  material->scale = params.Float("scale", 1, {0, 1e6});
  material->reflectance =
      TexturedColor(state, params, "reflectance", quarter, SpectrumUse::kAlbedo);
  material->transmittance =
      TexturedColor(state, params, "transmittance", quarter, SpectrumUse::kAlbedo);
}

// Absorption of one unit of each pigment (d'Eon et al. 2011, as published for linear
// RGB).
constexpr Rgb kEumelanin = {0.419, 0.697, 1.37}, kPheomelanin = {0.187, 0.4, 1.05};

// The first of four ways to state a colour counts, as in pbrt; the default is brown.
void ReadHairColor(ParseState& state, ParamSet& params, Material* material) {
  const char* const pigments[] = {"eumelanin", "pheomelanin"};
  const auto ignore = [&](std::initializer_list<const char*> names, const char* counts) {
    for (const char* name : names) {
      params.Ignore(name, fmt::format("\"{}\" counts", counts));
    }
  };
  const char* const color = params.Has("reflectance") ? "reflectance" : "color";
  if (params.Has("sigma_a")) {
    material->sigma_a =
        PlainColor(state, params, "sigma_a", {0, 0, 0}, SpectrumUse::kUnbounded);
    material->sigma_a_spectrum =
        SpectrumOf(state, params, *params.Find("sigma_a", {}), SpectrumUse::kUnbounded);
    return ignore({"reflectance", "color", pigments[0], pigments[1]}, "sigma_a");
  }
  material->has_reflectance = params.Has(color);
  if (material->has_reflectance) {
    material->reflectance =
        TexturedColor(state, params, color, {0, 0, 0}, SpectrumUse::kAlbedo);
    if (std::string_view(color) != "color") ignore({"color"}, color);
    return ignore({pigments[0], pigments[1]}, color);
  }
  const bool has_pigment = params.Has(pigments[0]) || params.Has(pigments[1]);
  const double eumelanin = params.Float(pigments[0], has_pigment ? 0 : 1.3, kNotNegative);
  const double pheomelanin = params.Float(pigments[1], 0, kNotNegative);
  material->sigma_a = kEumelanin * eumelanin + kPheomelanin * pheomelanin;
}

void ReadHair(ParseState& state, ParamSet& params, Material* material) {
  ReadHairColor(state, params, material);
  material->interface_eta = params.Float("eta", 1.55, {1, 10});
  material->beta_m = params.Float("beta_m", 0.3, {0, 1});
  material->beta_n = params.Float("beta_n", 0.3, {0, 1});
  material->tilt = params.Float("alpha", 2, {-90, 90});
}

void ReadMix(ParseState& state, ParamSet& params, Material* material) {
  const Param& names = params.Need("materials", ParamType::kString);
  if (names.strings.size() != 2) {
    params.Fail(names, "{} names; a mix takes 2", names.strings.size());
  }
  for (int i = 0; i < 2; ++i) {
    material->mix[i] =
        Resolve(state, {{NameKind::kMaterial, names.strings[i]}, names.where});
    if (state.scene.materials[material->mix[i]].inside != kNone) {
      params.Fail(
          names,
          "mixing a \"subsurface\" material is not supported: a shape has one inside");
    }
  }
  material->mix_amount = TexturedFloat(state, params, "amount", 0.5, {0, 1});
}

void ReadSubsurface(ParseState& state, ParamSet& params, Material* material) {
  material->interface_eta = DielectricEta(state, params, "eta", 1.33);
  ReadOwnRoughness(state, params, "", material);
  material->inside = InterpretInside(state, params, material->interface_eta);
  state.AddNoteOnce(
      params.where(),
      "material \"subsurface\" is rendered by random walks in a medium behind its "
      "surface, which must be closed; pbrt-v4 uses a tabulated profile");
}

void ReadMeasured(ParseState& state, ParamSet& params, Material* material) {
  const NamedFile file = RequireFile(state, params, "filename");
  if (!state.options.allow_files) {
    params.Fail(*file.param, "reading files is disabled here");
  }
  auto& read = state.measured[file.path];
  try {
    if (read == nullptr) read = ReadMeasuredReflectance(file.path);
  } catch (const InputError& error) {
    params.Fail(*file.param, WithoutPrefix(error));
  }
  material->measured = read;
}

struct MaterialType {
  MaterialKind kind;
  void (*read)(ParseState&, ParamSet&, Material*);
};
const std::map<std::string, MaterialType> kMaterials = {
    {"diffuse", {MaterialKind::kDiffuse, ReadDiffuse}},
    {"conductor", {MaterialKind::kConductor, ReadConductor}},
    {"dielectric", {MaterialKind::kDielectric, ReadDielectric}},
    {"thindielectric", {MaterialKind::kThinDielectric, ReadThinDielectric}},
    {"coateddiffuse", {MaterialKind::kCoatedDiffuse, ReadCoatedDiffuse}},
    {"coatedconductor", {MaterialKind::kCoatedConductor, ReadCoatedConductor}},
    {"diffusetransmission",
     {MaterialKind::kDiffuseTransmission, ReadDiffuseTransmission}},
    {"subsurface", {MaterialKind::kDielectric, ReadSubsurface}},
    {"measured", {MaterialKind::kMeasured, ReadMeasured}},
    {"hair", {MaterialKind::kHair, ReadHair}},
    {"mix", {MaterialKind::kMix, ReadMix}},
    {"interface", {MaterialKind::kInterface, [](ParseState&, ParamSet&, Material*) {}}}};

// Reads bump and normal maps. Some materials have no normal that these could change.
void ReadBumps(ParseState& state, ParamSet& params, Material* material) {
  static constexpr std::pair<MaterialKind, const char*> kWithout[] = {
      {MaterialKind::kMix, "the bump and normal maps of the mixed materials are used"},
      {MaterialKind::kInterface, "an interface has no surface of its own"},
      {MaterialKind::kHair, "hair has no bump or normal maps"}};
  for (const auto& [kind, why] : kWithout) {
    if (material->kind != kind) continue;
    params.Ignore("displacement", why);
    params.Ignore("normalmap", why);
    return;
  }
  material->displacement = TexturedFloat(state, params, "displacement", 0);
  const NamedFile map = FileOf(state, params, "normalmap");
  if (!map) return;
  material->normal_map = map.path;
  params.Ignore("displacement", "the normal map counts");
}

}  // namespace

Index InterpretMaterial(ParseState& state, const std::string& name,
                        const std::string& type, ParamSet& params) {
  Material material;
  material.name = name;
  material.where = params.where();
  const bool none = type.empty() || type == "none";
  if (none) {
    state.AddNote(params.where(),
                  "material \"\" and \"none\" are taken as \"interface\"");
  }
  const auto& [kind, read] =
      Lookup(kMaterials, none ? "interface" : type, params.where(), "material");
  material.kind = kind;
  read(state, params, &material);
  ReadBumps(state, params, &material);
  params.Find("type", {ParamType::kString});  // of MakeNamedMaterial, or superfluous
  params.CheckAllUsed();
  return Append(state.scene.materials, std::move(material));
}

}  // namespace lanelight
