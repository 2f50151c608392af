// Participating media. Coefficients end up per unit of world length, all scales included.
#include <algorithm>
#include <map>

#include "src/core/suggest.h"
#include "src/parse/interpret.h"

namespace lanelight {
namespace {

constexpr int kLongestSide = 4096;  // voxels
const std::vector<std::string> kMediumTypes = {"homogeneous", "uniformgrid", "rgbgrid"};
const std::vector<std::string> kForeignMedia = {"cloud", "nanovdb"};

struct Measured {
  Rgb sigma_s, sigma_a;  // per millimetre; sigma_s is the reduced one
};

// Jensen, Marschner, Levoy and Hanrahan 2001, "A Practical Model for Subsurface Light
// Transport", figure 5.
const std::map<std::string, Measured> kPresets = {
    {"Apple", {{2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}}},
    {"Chicken1", {{0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}}},
    {"Chicken2", {{0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}}},
    {"Cream", {{7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}}},
    {"Ketchup", {{0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}}},
    {"Marble", {{2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}}},
    {"Potato", {{0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}}},
    {"Skimmilk", {{0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}}},
    {"Skin1", {{0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}}},
    {"Skin2", {{1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}}},
    {"Spectralon", {{11.6, 20.4, 14.9}, {0.00, 0.00, 0.00}}},
    {"Wholemilk", {{2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}}}};

// By a preset, or each by itself; what is not given is that of whole milk, as in pbrt.
void ReadCoefficients(ParseState& state, ParamSet& params, Medium* medium) {
  const Param* preset = params.Find("preset", {ParamType::kString});
  const std::string name = params.String("preset", "Wholemilk");
  const auto it = kPresets.find(name);
  if (it == kPresets.end()) {
    ThrowUnknown(preset->where, "preset of a medium:", name, Names(kPresets));
  }
  for (const char* sigma : {"sigma_a", "sigma_s"}) {
    if (preset == nullptr || params.Find(sigma, {}) == nullptr) continue;
    params.Fail(*preset, fmt::format("\"preset\" and \"{}\" exclude each other", sigma));
  }
  medium->sigma_a =
      PlainColor(state, params, "sigma_a", it->second.sigma_a, SpectrumUse::kUnbounded);
  medium->sigma_s =
      PlainColor(state, params, "sigma_s", it->second.sigma_s, SpectrumUse::kUnbounded);
}

void ReadHomogeneous(ParseState& state, ParamSet& params, Medium* medium) {
  ReadCoefficients(state, params, medium);
  const double scale = params.Float("scale", 1, 0, kHuge);
  medium->sigma_a *= scale;
  medium->sigma_s *= scale;
  medium->emission =
      PlainColor(state, params, "Le", {0, 0, 0}, SpectrumUse::kIlluminant) *
      params.Float("Lescale", 1, 0, kHuge);
}

// Box and number of voxels, which is returned.
std::size_t ReadBox(ParamSet& params, Medium* medium) {
  static constexpr const char* kSides[] = {"nx", "ny", "nz"};
  std::size_t voxels = 1;
  for (int a = 0; a < 3; ++a) {
    medium->grid_size[a] = params.Integer(kSides[a], 1, 1, kLongestSide);
    voxels *= static_cast<std::size_t>(medium->grid_size[a]);
  }
  medium->box_min = params.Point3("p0", {0, 0, 0});
  medium->box_max = params.Point3("p1", {1, 1, 1});
  const Vec3d size = medium->box_max - medium->box_min;
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
    throw InputError(params.where(), params.object() +
                                         " has an empty box: every coordinate of "
                                         "\"p1\" must be above that of \"p0\"");
  }
  return voxels;
}

// `count` numbers per voxel, none negative; null if the parameter is not given.
const Param* Samples(ParamSet& params, std::string_view name, ParamType type,
                     std::size_t voxels, std::size_t count) {
  const Param* param = params.Find(name, {type});
  if (param == nullptr) return nullptr;
  if (param->numbers.size() != voxels * count) {
    params.Fail(*param, fmt::format("{} values; nx * ny * nz voxels need {}",
                                    param->numbers.size() / count, voxels));
  }
  for (const double v : param->numbers) {
    if (v < 0) params.Fail(*param, fmt::format("the value {} is negative", v));
  }
  return param;
}

void ReadUniformGrid(ParseState& state, ParamSet& params, Medium* medium) {
  medium->kind = MediumKind::kUniformGrid;
  const std::size_t voxels = ReadBox(params, medium);
  const Param* density = Samples(params, "density", ParamType::kFloat, voxels, 1);
  if (density == nullptr) {
    throw InputError(params.where(), params.object() + " has no \"float density\"");
  }
  medium->grid.assign(density->numbers.begin(), density->numbers.end());
  const Rgb one = {1, 1, 1};
  const double scale = params.Float("scale", 1, 0, kHuge);
  medium->sigma_a =
      PlainColor(state, params, "sigma_a", one, SpectrumUse::kUnbounded) * scale;
  medium->sigma_s =
      PlainColor(state, params, "sigma_s", one, SpectrumUse::kUnbounded) * scale;
  medium->emission =
      PlainColor(state, params, "Le", {0, 0, 0}, SpectrumUse::kIlluminant) *
      params.Float("Lescale", 1, 0, kHuge);
  if (const Param* t = params.Find("temperature", {})) {
    state.Unsupported(t->where,
                      "\"temperature\" of media is not supported; supported: "
                      "a constant \"Le\"");
  }
}

void ReadRgbGrid(ParseState& state, ParamSet& params, Medium* medium) {
  medium->kind = MediumKind::kRgbGrid;
  const std::size_t voxels = ReadBox(params, medium);
  const Param* a = Samples(params, "sigma_a", ParamType::kRgb, voxels, 3);
  const Param* s = Samples(params, "sigma_s", ParamType::kRgb, voxels, 3);
  if (a == nullptr && s == nullptr) {
    throw InputError(
        params.where(),
        params.object() + " has neither \"rgb sigma_a\" nor \"rgb sigma_s\"");
  }
  const double scale = params.Float("scale", 1, 0, kHuge);
  const auto value = [&](const Param* of, std::size_t i) {
    return static_cast<float>(scale * (of == nullptr ? 1 : of->numbers[i]));
  };
  for (std::size_t v = 0; v < voxels; ++v) {
    for (const Param* of : {a, s}) {
      for (std::size_t c = 0; c < 3; ++c) medium->grid.push_back(value(of, 3 * v + c));
    }
  }
  if (const Param* le = params.Find("Le", {})) {
    state.Unsupported(le->where, "\"Le\" of media of type \"rgbgrid\" is not supported");
  }
  params.Float("Lescale", 1, 0, kHuge);
}

}  // namespace

void InterpretMedium(ParseState& state, const std::string& name, ParamSet& params) {
  Medium medium;
  medium.name = name;
  medium.where = params.where();
  medium.world_from_medium = state.graphics.ctm;
  const Param* type_param = params.Find("type", {ParamType::kString});
  const std::string type = params.String("type", "");
  if (type_param == nullptr) {
    throw InputError(params.where(), params.object() + " has no \"string type\"");
  }
  if (std::find(kForeignMedia.begin(), kForeignMedia.end(), type) !=
      kForeignMedia.end()) {
    state.Unsupported(type_param->where,
                      fmt::format("media of type {} are not supported; supported: {}",
                                  Quoted(type), QuotedList(kMediumTypes)));
    state.media[name] = kNone;
    return;
  }
  if (type == "homogeneous") {
    ReadHomogeneous(state, params, &medium);
  } else if (type == "uniformgrid") {
    ReadUniformGrid(state, params, &medium);
  } else if (type == "rgbgrid") {
    ReadRgbGrid(state, params, &medium);
  } else {
    ThrowUnknown(type_param->where, "type of medium", type, kMediumTypes);
  }
  medium.g = params.Float("g", 0, -0.9999, 0.9999);
  params.CheckAllUsed();
  state.media[name] = static_cast<Index>(state.scene.media.size());
  state.scene.media.push_back(std::move(medium));
}

}  // namespace lanelight
