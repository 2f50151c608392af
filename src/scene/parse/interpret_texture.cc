#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

Vec3d VectorOf(ParamSet& params, std::string_view name, Vec3d absent) {
  const Param* param = params.Find(name, {ParamType::kVector3});
  if (param == nullptr) return absent;
  if (param->numbers.size() != 3) params.Fail(*param, "one vector is wanted");
  return Triples(*param)[0];
}

// A texture operand: colour or number, stored as a colour either way.
ColorValue Operand(ParseState& state, ParamSet& params, std::string_view name,
                   double absent, bool is_float) {
  if (!is_float) {
    return TexturedColor(state, params, name, {absent, absent, absent},
                         SpectrumUse::kUnbounded);
  }
  const FloatValue value = TexturedFloat(state, params, name, absent);
  return {{value.constant, value.constant, value.constant}, value.texture};
}

void ReadMapping(ParamSet& params, UvMapping* mapping) {
  mapping->kind = params.Choice<MappingKind>("mapping",
                                             {{"uv", MappingKind::kUv},
                                              {"spherical", MappingKind::kSpherical},
                                              {"cylindrical", MappingKind::kCylindrical},
                                              {"planar", MappingKind::kPlanar}},
                                             "uv");
  // pbrt accepts the parameters of other mappings too.
  mapping->su = params.Float("uscale", 1, Limits());
  mapping->sv = params.Float("vscale", 1, Limits());
  mapping->du = params.Float("udelta", 0, Limits());
  mapping->dv = params.Float("vdelta", 0, Limits());
  mapping->v1 = VectorOf(params, "v1", {1, 0, 0});
  mapping->v2 = VectorOf(params, "v2", {0, 1, 0});
}

// "sRGB", "linear" or "gamma <number>".
void ReadEncoding(ParamSet& params, Texture* texture) {
  const Param* param = params.Find("encoding", {ParamType::kString});
  if (param == nullptr) return;
  const std::string name = params.String("encoding", "");
  constexpr std::string_view kGamma = "gamma ";
  if (name == "sRGB" || name == "linear") {
    texture->encoding = name == "linear" ? Encoding::kLinear : Encoding::kSrgb;
    return;
  }
  if (!name.starts_with(kGamma)) {
    ThrowUnknown(param->where, "image encoding", name, {"sRGB", "linear", "gamma 2.2"});
  }
  Lexer lexer(std::string_view(name).substr(kGamma.size()), param->where.file);
  double gamma = 0;
  try {
    gamma = lexer.Next().number;
  } catch (const InputError&) {
    gamma = 0;  // not a number; the range check below reports it at the parameter
  }
  if (!(gamma >= 0.01 && gamma <= 100)) {
    params.Fail(*param, "{} needs a number from 0.01 to 100 after gamma", Quoted(name));
  }
  texture->encoding = Encoding::kGamma;
  texture->gamma = gamma;
}

void ReadImage(ParseState& state, ParamSet& params, Texture* texture) {
  const NamedFile file = RequireFile(state, params, "filename");
  texture->path = file.path;
  texture->where = file.param->where;  // where a missing image is reported
  texture->wrap = params.Choice<WrapMode>(
      "wrap", {{"repeat", WrapMode::kRepeat},
               {"clamp", WrapMode::kClamp},
               {"black", WrapMode::kBlack},
               {"octahedralsphere", WrapMode::kOctahedralSphere}});
  texture->filter = params.Choice<ImageFilter>("filter",
                                               {{"bilinear", ImageFilter::kBilinear},
                                                {"point", ImageFilter::kPoint},
                                                {"trilinear", ImageFilter::kTrilinear},
                                                {"ewa", ImageFilter::kEwa},
                                                {"EWA", ImageFilter::kEwa}},
                                               "ewa");
  // pbrt then interpolates in the finest image.
  if (state.unfiltered_images && texture->filter >= ImageFilter::kTrilinear) {
    texture->filter = ImageFilter::kBilinear;
  }
  texture->bilinear = texture->filter != ImageFilter::kPoint;
  texture->max_anisotropy = params.Float("maxanisotropy", 8, {1, 64});
  texture->scale = params.Float("scale", 1, Limits());
  texture->invert = params.Bool("invert", false);
  ReadEncoding(params, texture);
  ReadMapping(params, &texture->mapping);
}

void ReadCheckerboard(ParseState& state, ParamSet& params, Texture* texture) {
  texture->dimension = params.Integer("dimension", 2, {2, 3});
  if (!state.unfiltered_images) texture->filter = ImageFilter::kTrilinear;
  texture->tex1 = Operand(state, params, "tex1", 1, texture->is_float);
  texture->tex2 = Operand(state, params, "tex2", 0, texture->is_float);
  ReadMapping(params, &texture->mapping);
}

void ReadConstant(ParseState& state, ParamSet& params, Texture* texture) {
  const Param* value = params.Find(
      "value", texture->is_float
                   ? std::initializer_list<ParamType>{ParamType::kFloat}
                   : std::initializer_list<ParamType>{
                         ParamType::kRgb, ParamType::kSpectrum, ParamType::kBlackbody});
  texture->value = value == nullptr
                       ? Rgb{1, 1, 1}
                       : Operand(state, params, "value", 1, texture->is_float).constant;
}

void ReadScale(ParseState& state, ParamSet& params, Texture* texture) {
  texture->tex1 = Operand(state, params, "tex", 1, texture->is_float);
  texture->amount = TexturedFloat(state, params, "scale", 1);
}

void ReadMix(ParseState& state, ParamSet& params, Texture* texture) {
  texture->tex1 = Operand(state, params, "tex1", 0, texture->is_float);
  texture->tex2 = Operand(state, params, "tex2", 1, texture->is_float);
  texture->amount = TexturedFloat(state, params, "amount", 0.5, {0, 1});
}

void ReadDirectionMix(ParseState& state, ParamSet& params, Texture* texture) {
  texture->tex1 = Operand(state, params, "tex1", 0, texture->is_float);
  texture->tex2 = Operand(state, params, "tex2", 1, texture->is_float);
  const Vec3d direction = state.graphics.ctm.Vector(VectorOf(params, "dir", {0, 1, 0}));
  if (direction == Vec3d{}) {
    throw InputError(params.where(), params.object() + " has the direction 0 0 0");
  }
  texture->direction = Normalize(direction);
}

void ReadDots(ParseState& state, ParamSet& params, Texture* texture) {
  texture->tex1 = Operand(state, params, "inside", 1, texture->is_float);
  texture->tex2 = Operand(state, params, "outside", 0, texture->is_float);
  ReadMapping(params, &texture->mapping);
}

// pbrt takes constants at the corners, no textures.
void ReadBilinear(ParseState& state, ParamSet& params, Texture* texture) {
  constexpr const char* kCorners[] = {"v00", "v01", "v10", "v11"};
  for (int i = 0; i < 4; ++i) {
    texture->corners[i] = Operand(state, params, kCorners[i], i % 2, texture->is_float);
    if (texture->corners[i].texture == kNone) continue;
    params.Fail(*params.Find(kCorners[i], {}), "a corner takes a constant, no texture");
  }
  ReadMapping(params, &texture->mapping);
}

constexpr int kMaxOctaves = 64;

void ReadOctaves(ParseState&, ParamSet& params, Texture* texture) {
  texture->octaves = params.Integer("octaves", 8, {0, kMaxOctaves});
  texture->roughness = params.Float("roughness", 0.5, Limits());
}

void ReadMarble(ParseState& state, ParamSet& params, Texture* texture) {
  ReadOctaves(state, params, texture);
  texture->noise_scale = params.Float("scale", 1, Limits());
  texture->variation = params.Float("variation", 0.2, Limits());
}

struct TextureType {
  TextureKind kind;
  void (*read)(ParseState&, ParamSet&, Texture*);
  bool as_float = true, as_spectrum = true;  // pbrt has it as
};

const std::map<std::string, TextureType> kTextureTypes = {
    {"constant", {TextureKind::kConstant, ReadConstant}},
    {"scale", {TextureKind::kScale, ReadScale}},
    {"mix", {TextureKind::kMix, ReadMix}},
    {"directionmix", {TextureKind::kDirectionMix, ReadDirectionMix}},
    {"bilerp", {TextureKind::kBilinear, ReadBilinear}},
    {"imagemap", {TextureKind::kImage, ReadImage}},
    {"checkerboard", {TextureKind::kCheckerboard, ReadCheckerboard}},
    {"dots", {TextureKind::kDots, ReadDots}},
    {"fbm", {TextureKind::kFbm, ReadOctaves, true, false}},
    {"wrinkled", {TextureKind::kWrinkled, ReadOctaves, true, false}},
    {"windy",
     {TextureKind::kWindy, [](ParseState&, ParamSet&, Texture*) {}, true, false}},
    {"marble", {TextureKind::kMarble, ReadMarble, false, true}}};

const TextureType& FindType(const std::string& name, bool is_float,
                            const SourceLocation& where) {
  const auto found = kTextureTypes.find(name);
  const auto fits = [&](const TextureType& type) {
    return is_float ? type.as_float : type.as_spectrum;
  };
  if (found != kTextureTypes.end() && fits(found->second)) return found->second;
  if (name == "ptex") {
    throw InputError(where,
                     "texture \"ptex\" is not supported: this renderer has no per-face "
                     "textures (Ptex files); use an image with surface coordinates");
  }
  std::vector<std::string> names;
  for (const auto& [other, type] : kTextureTypes) {
    if (fits(type)) names.push_back(other);
  }
  ThrowUnknown(where, is_float ? "float texture" : "spectrum texture", name, names);
}

}  // namespace

void InterpretTexture(ParseState& state, const NameKey& key, const std::string& type,
                      ParamSet& params) {
  const bool is_float = key.first == NameKind::kFloatTexture;
  const TextureType& found = FindType(type, is_float, params.where());
  Texture texture;
  texture.kind = found.kind;
  texture.name = key.second;
  texture.where = params.where();
  texture.is_float = is_float;
  texture.texture_from_world = state.graphics.ctm.Inverse();
  NoteIgnoredMotion(state, texture.where, "texture");
  found.read(state, params, &texture);
  params.CheckAllUsed();
  Define(state, key, Append(state.scene.textures, std::move(texture)));
}

}  // namespace lanelight
