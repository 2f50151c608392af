// Tables that training has filled, in states: of path values, of where subpaths start,
// and of the selection of lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "src/base/core/error.h"
#include "src/render/train/training.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/learned_lights.h"

namespace lanelight {
namespace {

constexpr char kHead[] = "path_values";
constexpr char kSurvive[] = "path_values_survive";
constexpr char kInverse[] = "path_values_inverse";

// Left out unless light subpaths come from infinity.
constexpr char kEmissionCells[] = "emission_cells";
constexpr char kEmissionLights[] = "emission_lights";

constexpr std::uint64_t kHeadSize = 12;

// Left out without light-selection=learned.
constexpr char kLightGrid[] = "learned_light_grid";
constexpr char kLightRows[] = "learned_light_rows";
constexpr char kLightWeights[] = "learned_light_weights";

constexpr std::size_t kGridSize = 9;

std::vector<double> ValuesOf(const CellGrid& grid) {
  std::vector<double> values(grid.low, grid.low + 3);
  values.insert(values.end(), grid.per_unit, grid.per_unit + 3);
  values.insert(values.end(), grid.size, grid.size + 3);
  return values;
}

void ExportLights(const LearnedLights& lights, std::vector<TrainedTable>& trained) {
  trained.push_back(
      {kLightGrid, "low corner, cells per unit, cells", ValuesOf(lights.grid)});
  trained.push_back({kLightRows,
                     "row of weights, by cell and direction of the normal",
                     {lights.row.begin(), lights.row.end()}});
  trained.push_back(
      {kLightWeights, "weights of groups of lights, by row", lights.weights});
}

}  // namespace

std::vector<TrainedTable> ExportTraining(const StrategyTables& tables) {
  const PathValues& p = tables.path_values;
  std::vector<double> head = ValuesOf(p.grid);
  for (int i = 0; i < 3; ++i) head.push_back(double(p.channel[i]));
  std::vector<TrainedTable> trained = {
      {kHead, "grid: low corner, cells per unit, cells; weight of each channel", head},
      {kSurvive, "by cell", {p.survive.begin(), p.survive.end()}},
      {kInverse,
       "PilotImage::Inverse, by pixel of the full image and channel",
       {p.inverse_pixel.begin(), p.inverse_pixel.end()}}};
  if (tables.emission.has_learned()) {
    trained.push_back({kEmissionCells, "weights of where subpaths from infinity start",
                       tables.emission.cell_weights});
    trained.push_back({kEmissionLights, "weights of the lights where subpaths start",
                       tables.emission.light_weights});
  }
  if (tables.lights.has_learned()) ExportLights(tables.lights, trained);
  return trained;
}

const std::vector<double>& TableOf(const std::vector<TrainedTable>& trained,
                                   const std::string& name) {
  for (const TrainedTable& table : trained) {
    if (table.name == name) return table.values;
  }
  throw InputError(fmt::format("the state has no table '{}'", name));
}

namespace {

// `why` says what the right size comes from.
void CheckSize(const char* table, std::size_t size, std::uint64_t right,
               const std::string& why) {
  if (size == right) return;
  throw InputError(fmt::format("the state's table '{}' has {} values; expected {}: {}",
                               table, size, right, why));
}

void CheckPixels(const char* table, std::size_t size, std::uint64_t pixels) {
  CheckSize(table, size, 3 * pixels,
            fmt::format("3 for each of the {} pixels of the full image", pixels));
}

void Put(const std::vector<double>& values, AlignedVector<float>& out) {
  out.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i] = float(values[i]);
}

CellGrid GridOf(const std::vector<double>& values) {
  CellGrid grid;
  for (std::size_t i = 0; i < 3; ++i) {
    grid.low[i] = float(values[i]);
    grid.per_unit[i] = float(values[3 + i]);
    grid.size[i] = std::int32_t(values[6 + i]);
  }
  return grid;
}

void PutHead(const std::vector<double>& head, PathValues& p) {
  CheckSize(kHead, head.size(), kHeadSize, "whatever the scene");
  p.grid = GridOf(head);
  for (std::size_t i = 0; i < 3; ++i) p.channel[i] = float(head[kGridSize + i]);
}

// Six directions of the normal in each cell of the grid.
void CheckCells(const char* table, const std::vector<double>& head, std::size_t size) {
  const double right = 6 * head[6] * head[7] * head[8];
  if (head[6] >= 1 && head[7] >= 1 && head[8] >= 1 && right == double(size)) return;
  throw InputError(
      fmt::format("the state's table '{}' has {} values; expected {:.0f}: 6 for each of "
                  "{} x {} x {} cells",
                  table, size, right, head[6], head[7], head[8]));
}

void PutEmission(const std::vector<TrainedTable>& trained, EmissionGuide& guide) {
  EmissionWeights weights = {TableOf(trained, kEmissionCells),
                             TableOf(trained, kEmissionLights)};
  CheckSize(kEmissionCells, weights.cells.size(), guide.num_cells,
            "that of the scene's lights at infinity");
  CheckSize(kEmissionLights, weights.lights.size(), guide.distant.size(),
            "one for each light");
  if (!AreUsable(weights, guide)) {
    throw InputError(fmt::format(
        "the state's tables '{}' and '{}' must have finite values of at least 0, and "
        "some above 0 in each square and among the lights",
        kEmissionCells, kEmissionLights));
  }
  Learn(std::move(weights), guide);
}

bool AreUsable(const std::vector<double>& rows, const LearnedLights& lights) {
  const double num_rows = double(lights.weights.size()) / lights.num_groups;
  for (const double row : rows) {
    if (!(row >= 0 && row < num_rows)) return false;
  }
  for (std::size_t at = 0; at < lights.weights.size(); at += lights.num_groups) {
    double sum = 0;
    for (const double w : std::span(lights.weights).subspan(at, lights.num_groups)) {
      if (!(w >= 0)) return false;
      sum += w;
    }
    if (!(sum > 0) || !std::isfinite(sum)) return false;
  }
  return true;
}

void PutLights(const std::vector<TrainedTable>& trained, LearnedLights& lights) {
  const std::vector<double>& grid = TableOf(trained, kLightGrid);
  const std::vector<double>& rows = TableOf(trained, kLightRows);
  CheckSize(kLightGrid, grid.size(), kGridSize, "whatever the scene");
  CheckCells(kLightRows, grid, rows.size());
  lights.grid = GridOf(grid);
  lights.weights = TableOf(trained, kLightWeights);
  const std::size_t size = lights.weights.size();
  CheckSize(kLightWeights, size, size - size % std::max(lights.num_groups, 1u),
            "one for each group of lights in each row");
  if (lights.num_groups == 0 || !AreUsable(rows, lights)) {
    throw InputError(fmt::format(
        "the state's tables '{}' and '{}' must have indices of rows, and in each row "
        "finite weights of at least 0, some above 0",
        kLightRows, kLightWeights));
  }
  lights.row.assign(rows.begin(), rows.end());
  SetProbabilities(lights);
}

}  // namespace

void ImportTraining(const std::vector<TrainedTable>& trained, std::uint64_t pixels,
                    StrategyTables& tables) {
  PathValues& p = tables.path_values;
  const std::vector<double>& head = TableOf(trained, kHead);
  PutHead(head, p);
  Put(TableOf(trained, kSurvive), p.survive);
  Put(TableOf(trained, kInverse), p.inverse_pixel);
  const std::size_t cells = p.survive.size();
  if (cells > 0) CheckCells(kSurvive, head, cells);
  if (cells > 0 || !p.inverse_pixel.empty()) {
    CheckPixels(kInverse, p.inverse_pixel.size(), pixels);
  }
  const auto has = [&trained](const char* name) {
    return std::ranges::any_of(trained,
                               [&](const TrainedTable& t) { return t.name == name; });
  };
  if (has(kEmissionCells)) PutEmission(trained, tables.emission);
  if (has(kLightRows)) PutLights(trained, tables.lights);
}

void CheckTrained(const Plan& plan, const StrategyTables& tables) {
  const auto check = [&plan](Feature needs, bool empty, const char* table) {
    if (!empty || !plan.features.Has(needs)) return;
    throw InputError(fmt::format(
        "the state's table '{}' is empty or missing: its strategy needs it", table));
  };
  check(Feature::kSplitting, tables.path_values.survive.empty(), kSurvive);
  check(Feature::kGuidedEmission, !tables.emission.has_learned(), kEmissionCells);
  check(Feature::kLearnedLights, !tables.lights.has_learned(), kLightRows);
}

}  // namespace lanelight
