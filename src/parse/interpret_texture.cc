#include <algorithm>

#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr double kHuge = 1e30;

// A texture operand: colour or number, stored as a colour either way.
ColorValue Operand(ParseState& state, ParamSet& params, std::string_view name,
                   double absent, bool is_float) {
  if (!is_float) {
    return TexturedColor(state, params, name, {absent, absent, absent},
                         SpectrumUse::kUnbounded);
  }
  const FloatValue value = TexturedFloat(state, params, name, absent, -kHuge, kHuge);
  return {{value.constant, value.constant, value.constant}, value.texture};
}

void ReadMapping(ParamSet& params, UvMapping* mapping) {
  params.Choice("mapping", {"uv"});
  mapping->su = params.Float("uscale", 1, -kHuge, kHuge);
  mapping->sv = params.Float("vscale", 1, -kHuge, kHuge);
  mapping->du = params.Float("udelta", 0, -kHuge, kHuge);
  mapping->dv = params.Float("vdelta", 0, -kHuge, kHuge);
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
    params.Fail(*param, fmt::format("{} needs a number from 0.01 to 100 after gamma",
                                    Quoted(name)));
  }
  texture->encoding = Encoding::kGamma;
  texture->gamma = gamma;
}

void ReadImage(ParseState& state, ParamSet& params, Texture* texture) {
  const Param* file = params.Find("filename", {ParamType::kString});
  if (file == nullptr) {
    throw InputError(params.where(), "texture \"imagemap\" has no \"string filename\"");
  }
  const std::string name = params.String("filename", "");
  if (name.empty()) params.Fail(*file, "the file name is empty");
  texture->path = ResolvePath(state, name);
  texture->where = file->where;  // what a missing image is reported at
  constexpr WrapMode kWraps[] = {WrapMode::kRepeat, WrapMode::kClamp, WrapMode::kBlack,
                                 WrapMode::kOctahedralSphere};
  texture->wrap =
      kWraps[params.Choice("wrap", {"repeat", "clamp", "black", "octahedralsphere"})];
  const int filter =
      params.Choice("filter", {"bilinear", "point", "trilinear", "ewa", "EWA"});
  texture->bilinear = filter != 1;
  if (filter > 1) {
    state.AddNoteOnce(params.where(),
                      "texture filters \"trilinear\" and \"ewa\" are taken as "
                      "\"bilinear\"");
  }
  params.Ignore("maxanisotropy", "there is no anisotropic filter");
  texture->scale = params.Float("scale", 1, -kHuge, kHuge);
  texture->invert = params.Bool("invert", false);
  ReadEncoding(params, texture);
  ReadMapping(params, &texture->mapping);
}

void ReadCheckerboard(ParseState& state, ParamSet& params, Texture* texture) {
  const int dimension = params.Integer("dimension", 2, 2, 3);
  if (dimension == 3) {
    params.Fail(*params.Find("dimension", {}),
                "3-dimensional checkerboards are not "
                "supported; 2 is");
  }
  texture->tex1 = Operand(state, params, "tex1", 1, texture->is_float);
  texture->tex2 = Operand(state, params, "tex2", 0, texture->is_float);
  ReadMapping(params, &texture->mapping);
}

}  // namespace

void InterpretTexture(ParseState& state, const std::string& name, bool is_float,
                      const std::string& type, ParamSet& params) {
  Texture texture;
  texture.name = name;
  texture.where = params.where();
  texture.is_float = is_float;
  if (type == "constant") {
    texture.kind = TextureKind::kConstant;
    const Param* value = params.Find(
        "value", is_float
                     ? std::initializer_list<ParamType>{ParamType::kFloat}
                     : std::initializer_list<ParamType>{
                           ParamType::kRgb, ParamType::kSpectrum, ParamType::kBlackbody});
    texture.value = value == nullptr
                        ? Rgb{1, 1, 1}
                        : Operand(state, params, "value", 1, is_float).constant;
  } else if (type == "scale") {
    texture.kind = TextureKind::kScale;
    texture.tex1 = Operand(state, params, "tex", 1, is_float);
    texture.amount = TexturedFloat(state, params, "scale", 1, -kHuge, kHuge);
  } else if (type == "mix") {
    texture.kind = TextureKind::kMix;
    texture.tex1 = Operand(state, params, "tex1", 0, is_float);
    texture.tex2 = Operand(state, params, "tex2", 1, is_float);
    texture.amount = TexturedFloat(state, params, "amount", 0.5, 0, 1);
  } else if (type == "checkerboard") {
    texture.kind = TextureKind::kCheckerboard;
    ReadCheckerboard(state, params, &texture);
  } else if (type == "imagemap") {
    texture.kind = TextureKind::kImage;
    ReadImage(state, params, &texture);
  } else {
    ThrowUnknown(params.where(), "texture", type,
                 {"constant", "scale", "mix", "checkerboard", "imagemap"});
  }
  params.CheckAllUsed();
  const Index index = static_cast<Index>(state.scene.textures.size());
  (is_float ? state.float_textures : state.color_textures)[name] = index;
  state.scene.textures.push_back(std::move(texture));
}

}  // namespace lanelight
