// Participating media. Coefficients end up per unit of world length, all scales included.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/medium_kinds.h"
#include "src/scene/parse/motion.h"
#include "src/scene/parse/scattering_presets.h"

namespace lanelight {
namespace {

// Null if there is none of that name: pbrt-v4 then goes on with a warning.
const Coefficients* FindPreset(ParseState& state, ParamSet& params) {
  const Param* preset = params.Find("preset", {ParamType::kString});
  if (preset == nullptr) return nullptr;
  const std::string name = params.String("preset", "");
  const Coefficients* found = FindCoefficients(name);
  if (found != nullptr) return found;
  const std::string near = NearestName(name, NamesOfCoefficients());
  state.AddNote(preset->where,
                fmt::format("unknown preset {} of a medium{}: its \"sigma_a\" and "
                            "\"sigma_s\" count, each 1 by default",
                            Quoted(name),
                            near.empty() ? "" : " (did you mean " + Quoted(near) + "?)"),
                true);
  return nullptr;
}

// From a preset, or else each by itself.
void ReadCoefficients(ParseState& state, ParamSet& params, Medium* medium) {
  const double scale = params.Float("scale", 1, kNotNegative);
  const Coefficients* preset = FindPreset(state, params);
  if (preset == nullptr) return ReadSigmas(state, params, scale, medium);
  for (const char* sigma : {"sigma_a", "sigma_s"}) {
    if (params.Find(sigma, {}) == nullptr) continue;
    params.Fail(*params.Find("preset", {}),
                fmt::format("\"preset\" and \"{}\" exclude each other", sigma));
  }
  medium->sigma_a = preset->sigma_a * scale;
  medium->sigma_s = preset->sigma_s * scale;
}

void ReadHomogeneous(ParseState& state, ParamSet& params, Medium* medium) {
  ReadCoefficients(state, params, medium);
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
