// Participating media. Coefficients end up per unit of world length, all scales included.
#include <algorithm>
#include <map>

#include "src/core/suggest.h"
#include "src/parse/interpret.h"
#include "src/parse/medium_kinds.h"

namespace lanelight {
namespace {

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
  const SourceLocation& where = preset == nullptr ? params.where() : preset->where;
  const Measured& milk = Lookup(kPresets, name, where, "preset of a medium:");
  for (const char* sigma : {"sigma_a", "sigma_s"}) {
    if (preset == nullptr || params.Find(sigma, {}) == nullptr) continue;
    params.Fail(*preset, fmt::format("\"preset\" and \"{}\" exclude each other", sigma));
  }
  medium->sigma_a =
      PlainColor(state, params, "sigma_a", milk.sigma_a, SpectrumUse::kUnbounded);
  medium->sigma_s =
      PlainColor(state, params, "sigma_s", milk.sigma_s, SpectrumUse::kUnbounded);
}

void ReadHomogeneous(ParseState& state, ParamSet& params, Medium* medium) {
  ReadCoefficients(state, params, medium);
  const double scale = params.Float("scale", 1, kNotNegative);
  medium->sigma_a *= scale;
  medium->sigma_s *= scale;
  medium->emission =
      PlainColor(state, params, "Le", {0, 0, 0}, SpectrumUse::kIlluminant) *
      params.Float("Lescale", 1, kNotNegative);
}

struct MediumType {
  MediumKind kind;
  void (*read)(ParseState&, ParamSet&, Medium*);
};
const std::map<std::string, MediumType> kMediumTypes = {
    {"homogeneous", {MediumKind::kHomogeneous, ReadHomogeneous}},
    {"uniformgrid", {MediumKind::kUniformGrid, ReadUniformGrid}},
    {"rgbgrid", {MediumKind::kRgbGrid, ReadRgbGrid}},
    {"cloud", {MediumKind::kCloud, ReadCloud}},
    {"nanovdb", {MediumKind::kNanoVdb, ReadNanoVdb}}};

}  // namespace

void InterpretMedium(ParseState& state, const std::string& name, ParamSet& params) {
  Medium medium;
  medium.name = name;
  medium.where = params.where();
  medium.world_from_medium = state.graphics.ctm;
  const SourceLocation& where = params.Need("type", ParamType::kString).where;
  const std::string type = params.String("type", "");
  const auto& [kind, read] = Lookup(kMediumTypes, type, where, "type of medium");
  medium.kind = kind;
  read(state, params, &medium);
  medium.g = params.Float("g", 0, {-0.9999, 0.9999});
  params.CheckAllUsed();
  state.media[name] = static_cast<Index>(state.scene.media.size());
  state.scene.media.push_back(std::move(medium));
}

}  // namespace lanelight
