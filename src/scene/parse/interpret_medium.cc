// Participating media. Coefficients are per unit of world length, scales included.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/image/sparse_grid.h"
#include "src/scene/parse/interpret.h"
#include "src/scene/parse/motion.h"

namespace lanelight {
namespace {

// Null for an unknown name, with which pbrt-v4 goes on after a warning.
const Coefficients* FindPreset(ParseState& state, ParamSet& params) {
  const Param* preset = params.Find("preset", {ParamType::kString});
  if (preset == nullptr) return nullptr;
  const std::string name = params.String("preset", "");
  const auto found = ScatteringPresets().find(name);
  if (found != ScatteringPresets().end()) return &found->second;
  const std::string near = NearestName(name, Names(ScatteringPresets()));
  state.AddImageNote(
      preset->where,
      fmt::format("unknown preset {} of a medium{}: its \"sigma_a\" and \"sigma_s\" "
                  "count, each 1 by default",
                  Quoted(name),
                  near.empty() ? "" : " (did you mean " + Quoted(near) + "?)"));
  return nullptr;
}

void ReadCoefficients(ParseState& state, ParamSet& params, Medium* medium) {
  const double scale = params.Float("scale", 1, kNotNegative);
  const Coefficients* preset = FindPreset(state, params);
  if (preset == nullptr) return ReadSigmas(state, params, scale, medium);
  for (const char* sigma : {"sigma_a", "sigma_s"}) {
    if (!params.Has(sigma)) continue;
    params.Fail(*params.Find("preset", {}), "\"preset\" and \"{}\" exclude each other",
                sigma);
  }
  medium->sigma_a = preset->sigma_a * scale;
  medium->sigma_s = preset->sigma_s * scale;
}

void ReadHomogeneous(ParseState& state, ParamSet& params, Medium* medium) {
  ReadCoefficients(state, params, medium);
  ReadEmission(state, params, params.Float("Lescale", 1, kNotNegative), medium);
}

// Reads a grid by its name; null if the file has no such grid.
std::shared_ptr<const SparseGrid> ReadGrid(const ParamSet& params, const Param& file,
                                           const std::string& path,
                                           const std::string& name) {
  try {
    return ReadSparseGrid(path, name);
  } catch (const InputError& error) {
    params.Fail(file, WithoutPrefix(error));
  }
}

void SetBox(Medium* medium) {
  const SparseGrid& density = *medium->sparse_density;
  medium->box_min = density.box_min(), medium->box_max = density.box_max();
  if (medium->sparse_temperature == nullptr) return;
  medium->box_min = Min(medium->box_min, medium->sparse_temperature->box_min());
  medium->box_max = Max(medium->box_max, medium->sparse_temperature->box_max());
}

void ReadCloud(ParseState& state, ParamSet& params, Medium* medium) {
  ReadBox(params, medium);
  ReadSigmas(state, params, 1, medium);
  medium->density = params.Float("density", 1, kNotNegative);
  medium->wispiness = params.Float("wispiness", 1, kNotNegative);
  medium->frequency = params.Float("frequency", 5, kNotNegative);
}

void ReadNanoVdb(ParseState& state, ParamSet& params, Medium* medium) {
  const auto [file, path] = RequireFile(state, params, "filename");
  if (!state.options.allow_files) {
    throw InputError(file->where,
                     "found the NanoVDB file {}, but reading files is disabled here",
                     Quoted(file->strings[0]));
  }
  const std::string density = params.String("gridname", "density");
  medium->sparse_density = ReadGrid(params, *file, path, density);
  if (medium->sparse_density == nullptr) {
    params.Fail(*file, "the file {} has no grid {}", Quoted(path), Quoted(density));
  }
  if (medium->sparse_density->smallest() < 0) {
    params.Fail(*file, "the grid {} has the negative density {}", Quoted(density),
                medium->sparse_density->smallest());
  }
  const std::string temperature = params.String("temperaturename", "temperature");
  medium->sparse_temperature = ReadGrid(params, *file, path, temperature);
  ReadSigmas(state, params, params.Float("scale", 1, kNotNegative), medium);
  ReadTemperatureScale(params, medium);
  // Earlier versions of pbrt capitalise it differently.
  const double le_scale = params.Float("LeScale", 1, kNotNegative);
  const double scale = params.Float("Lescale", le_scale, kNotNegative);
  if (medium->sparse_temperature != nullptr) medium->emission = Rgb{1, 1, 1} * scale;
  SetBox(medium);
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
  NoteIgnoredMotion(state, medium.where, "medium");
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
