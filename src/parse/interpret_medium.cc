// Participating media. Coefficients end up per unit of world length, all scales included.
#include <algorithm>
#include <map>

#include "src/core/suggest.h"
#include "src/parse/interpret.h"
#include "src/parse/motion.h"
#include "src/parse/medium_kinds.h"
#include "src/parse/scattering_presets.h"

namespace lanelight {
namespace {

// By a preset, or each by itself; what is not given is that of whole milk, as in pbrt.
void ReadCoefficients(ParseState& state, ParamSet& params, Medium* medium) {
  const Param* preset = params.Find("preset", {ParamType::kString});
  const std::string name = params.String("preset", "Wholemilk");
  const SourceLocation& where = preset == nullptr ? params.where() : preset->where;
  const Coefficients& milk = CoefficientsOf(name, where, "preset of a medium:");
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
  ReadEmission(state, params, params.Float("Lescale", 1, kNotNegative), medium);
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
  NoteStill(state, medium.where, "medium");
  const SourceLocation& where = params.Need("type", ParamType::kString).where;
  const std::string type = params.String("type", "");
  const auto& [kind, read] = Lookup(kMediumTypes, type, where, "type of medium");
  medium.kind = kind;
  read(state, params, &medium);
  medium.g = params.Float("g", 0, {-0.9999, 0.9999});
  params.CheckAllUsed();
  DefineMedium(state, std::move(medium));
}

}  // namespace lanelight
