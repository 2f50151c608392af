#include <fmt/format.h>

#include "src/base/core/error_text.h"
#include "src/base/core/suggest.h"
#include "src/base/image/sparse_grid.h"
#include "src/scene/parse/medium_kinds.h"

namespace lanelight {
namespace {

// Reads a grid by its name in the scene file; returns null if the file has no such grid.
std::shared_ptr<const SparseGrid> ReadGrid(const ParamSet& params, const Param& file,
                                           const std::string& path,
                                           const std::string& name) {
  try {
    return ReadSparseGrid(path, name);
  } catch (const InputError& error) {
    params.Fail(file, WithoutPrefix(error));
  }
}

// Around both grids.
void SetBox(Medium* medium) {
  const SparseGrid& density = *medium->sparse_density;
  medium->box_min = density.box_min(), medium->box_max = density.box_max();
  if (medium->sparse_temperature == nullptr) return;
  medium->box_min = Min(medium->box_min, medium->sparse_temperature->box_min());
  medium->box_max = Max(medium->box_max, medium->sparse_temperature->box_max());
}

}  // namespace

void ReadCloud(ParseState& state, ParamSet& params, Medium* medium) {
  ReadBox(params, medium);
  ReadSigmas(state, params, 1, medium);
  medium->density = params.Float("density", 1, kNotNegative);
  medium->wispiness = params.Float("wispiness", 1, kNotNegative);
  medium->frequency = params.Float("frequency", 5, kNotNegative);
}

void ReadNanoVdb(ParseState& state, ParamSet& params, Medium* medium) {
  const Param* file = params.Find("filename", {ParamType::kString});
  const std::string name = params.String("filename", "");
  if (file == nullptr || name.empty()) {
    throw InputError(params.where(), params.object() + " has no \"string filename\"");
  }
  if (!state.options.allow_files) {
    throw InputError(file->where, fmt::format("found the NanoVDB file {}, but files may "
                                              "not be read here",
                                              Quoted(name)));
  }
  const std::string path = ResolvePath(state, name);
  const std::string density = params.String("gridname", "density");
  medium->sparse_density = ReadGrid(params, *file, path, density);
  if (medium->sparse_density == nullptr) {
    params.Fail(*file,
                fmt::format("the file {} has no grid {}", Quoted(path), Quoted(density)));
  }
  if (medium->sparse_density->smallest() < 0) {
    params.Fail(*file, fmt::format("the grid {} has the negative density {}",
                                   Quoted(density), medium->sparse_density->smallest()));
  }
  const std::string temperature = params.String("temperaturename", "temperature");
  medium->sparse_temperature = ReadGrid(params, *file, path, temperature);
  ReadSigmas(state, params, params.Float("scale", 1, kNotNegative), medium);
  ReadTemperatureScale(params, medium);
  // Earlier versions of pbrt wrote it with another capital.
  const double le_scale = params.Float("LeScale", 1, kNotNegative);
  const double scale = params.Float("Lescale", le_scale, kNotNegative);
  if (medium->sparse_temperature != nullptr) medium->emission = Rgb{1, 1, 1} * scale;
  SetBox(medium);
}

}  // namespace lanelight
