#include "src/render/train/training.h"

#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <utility>

#include "src/base/core/error.h"
#include "src/scene/prepare/emission_guide.h"

namespace lanelight {

bool NeedsTraining(const Plan& plan) {
  return plan.features.HasAny(
      {Feature::kDecides, Feature::kPathValues, Feature::kGuidedEmission});
}

TrainingOutcome Train(const TrainingContext& context) {
  const FeatureSet& features = context.plan.features;
  if (features.Has(Feature::kDecides)) return TrainDecision(context);
  if (features.Has(Feature::kPathValues)) return TrainPathValues(context);
  if (features.Has(Feature::kGuidedEmission)) return TrainEmission(context);
  return {};
}

namespace {

constexpr char kHead[] = "path_values";
constexpr char kSurvive[] = "path_values_survive";
constexpr char kSplit[] = "path_values_split";
constexpr char kInverse[] = "path_values_inverse";

// Left out unless light subpaths come from infinity.
constexpr char kEmissionCells[] = "emission_cells";
constexpr char kEmissionLights[] = "emission_lights";

constexpr std::uint64_t kHeadSize = 13;

}  // namespace

std::vector<TrainedTable> ExportTraining(const StrategyTables& tables) {
  const PathValues& p = tables.path_values;
  const CellGrid& g = p.grid;
  std::vector<double> head;
  for (int i = 0; i < 3; ++i) head.push_back(double(g.low[i]));
  for (int i = 0; i < 3; ++i) head.push_back(double(g.per_unit[i]));
  for (int i = 0; i < 3; ++i) head.push_back(g.size[i]);
  for (int i = 0; i < 3; ++i) head.push_back(double(p.channel[i]));
  head.push_back(double(p.scale));
  std::vector<TrainedTable> trained = {
      {kHead, "grid: low corner, cells per unit, cells; weight of each channel; scale",
       head},
      {kSurvive, "by cell", {p.survive.begin(), p.survive.end()}},
      {kSplit, "by cell", {p.split.begin(), p.split.end()}},
      {kInverse,
       "ImageGuess::Inverse, by pixel of the full image and channel",
       {p.inverse_pixel.begin(), p.inverse_pixel.end()}}};
  if (tables.emission.has_learned()) {
    trained.push_back({kEmissionCells, "weights of where subpaths from infinity start",
                       tables.emission.cell_weights});
    trained.push_back({kEmissionLights, "weights of the lights where subpaths start",
                       tables.emission.light_weights});
  }
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

void PutHead(const std::vector<double>& head, PathValues& p) {
  CheckSize(kHead, head.size(), kHeadSize, "whatever the scene");
  for (std::size_t i = 0; i < 3; ++i) {
    p.grid.low[i] = float(head[i]);
    p.grid.per_unit[i] = float(head[3 + i]);
    p.grid.size[i] = std::int32_t(head[6 + i]);
    p.channel[i] = float(head[9 + i]);
  }
  p.scale = float(head[12]);
}

// Six directions of the normal in each cell of the grid.
void CheckCells(const std::vector<double>& head, std::size_t size) {
  const double right = 6 * head[6] * head[7] * head[8];
  if (head[6] >= 1 && head[7] >= 1 && head[8] >= 1 && right == double(size)) return;
  throw InputError(
      fmt::format("the state's table '{}' has {} values; expected {:.0f}: 6 for each of "
                  "{} x {} x {} cells",
                  kSurvive, size, right, head[6], head[7], head[8]));
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

}  // namespace

void ImportTraining(const std::vector<TrainedTable>& trained, std::uint64_t pixels,
                    StrategyTables& tables) {
  PathValues& p = tables.path_values;
  const std::vector<double>& head = TableOf(trained, kHead);
  PutHead(head, p);
  Put(TableOf(trained, kSurvive), p.survive);
  Put(TableOf(trained, kSplit), p.split);
  Put(TableOf(trained, kInverse), p.inverse_pixel);
  const std::size_t cells = p.survive.size();
  if (cells > 0) CheckCells(head, cells);
  const std::string why = "one for each value of 'path_values_survive'";
  if (!p.split.empty()) CheckSize(kSplit, p.split.size(), cells, why);
  if (cells > 0 || !p.inverse_pixel.empty()) {
    CheckPixels(kInverse, p.inverse_pixel.size(), pixels);
  }
  const auto has_cells = [](const TrainedTable& t) { return t.name == kEmissionCells; };
  if (std::ranges::any_of(trained, has_cells)) PutEmission(trained, tables.emission);
}

void CheckTrained(const Plan& plan, const StrategyTables& tables) {
  const auto check = [&plan](Feature needs, bool empty, const char* table) {
    if (!empty || !plan.features.Has(needs)) return;
    throw InputError(fmt::format(
        "the state's table '{}' is empty or missing: its strategy needs it", table));
  };
  check(Feature::kPathValues, tables.path_values.survive.empty(), kSurvive);
  check(Feature::kGuidedEmission, !tables.emission.has_learned(), kEmissionCells);
  check(Feature::kEfficiencyRoulette, tables.path_values.split.empty(), kSplit);
}

}  // namespace lanelight
