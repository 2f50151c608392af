#include "src/wavefront/training.h"

#include <algorithm>

#include "src/core/error.h"
#include "src/wavefront/guide_tables.h"

namespace lanelight {
namespace {

struct Training {
  Feature asks;
  TrainingOutcome (*train)(const TrainingContext&);
};

// Left out of the state where nothing is known.
constexpr char kShadowWorth[] = "shadow_worth_inverse";

constexpr Training kTrainings[] = {
#define X(name, feature) {Feature::feature, Train##name},
    LANELIGHT_TRAININGS(X)
#undef X
};

}  // namespace

bool NeedsTraining(const Plan& plan) {
  if (plan.features.Has(Feature::kDecides)) return true;
  for (const Training& t : kTrainings) {
    if (plan.features.Has(t.asks)) return true;
  }
  return false;
}

TrainingOutcome Train(const TrainingContext& context) {
  if (context.plan.features.Has(Feature::kDecides)) return TrainDecision(context);
  TrainingOutcome all;
  for (const Training& t : kTrainings) {
    if (!context.plan.features.Has(t.asks)) continue;
    const TrainingOutcome one = t.train(context);
    if (!one.changes.empty()) all.changes = one.changes;
    all.note += (all.note.empty() || one.note.empty() ? "" : "; ") + one.note;
    all.samples += one.samples;
    all.rays += one.rays;
  }
  return all;
}

std::vector<TrainedTable> TakeTraining(const StrategyTables& tables) {
  const PathValues& p = tables.path_values;
  const CellGrid& g = p.grid;
  std::vector<double> head;
  for (int i = 0; i < 3; ++i) head.push_back(double(g.low[i]));
  for (int i = 0; i < 3; ++i) head.push_back(double(g.per_unit[i]));
  for (int i = 0; i < 3; ++i) head.push_back(g.size[i]);
  for (int i = 0; i < 3; ++i) head.push_back(double(p.channel[i]));
  head.push_back(double(p.scale));
  std::vector<TrainedTable> trained = {
      {"path_values",
       "grid: low corner, cells per unit, cells; weight of each channel; scale", head},
      {"path_values_survive", "by cell", {p.survive.begin(), p.survive.end()}},
      {"path_values_split", "by cell", {p.split.begin(), p.split.end()}},
      {"path_values_inverse",
       "ImageGuess::Inverse, by pixel of the full image and channel",
       {p.inverse_pixel.begin(), p.inverse_pixel.end()}}};
  const AlignedVector<float>& shadow = tables.shadow_worth.inverse;
  if (!shadow.empty()) {
    trained.push_back(
        {kShadowWorth,
         "inverse worth of shadow rays, by pixel of the full image and channel",
         {shadow.begin(), shadow.end()}});
  }
  for (TrainedTable& table : TakeGuide(tables.guide)) trained.push_back(std::move(table));
  return trained;
}

namespace {

bool HasTable(const std::vector<TrainedTable>& trained, const std::string& name) {
  return std::any_of(trained.begin(), trained.end(),
                     [&](const TrainedTable& table) { return table.name == name; });
}

const std::vector<double>& TableOf(const std::vector<TrainedTable>& trained,
                                   const std::string& name) {
  for (const TrainedTable& table : trained) {
    if (table.name == name) return table.values;
  }
  throw InputError(fmt::format("the state has no table '{}'", name));
}

void Put(const std::vector<double>& values, AlignedVector<float>& out) {
  out.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i] = static_cast<float>(values[i]);
}

}  // namespace

void PutTraining(const std::vector<TrainedTable>& trained, StrategyTables& tables) {
  PathValues& p = tables.path_values;
  const std::vector<double>& head = TableOf(trained, "path_values");
  if (head.size() != 13) throw InputError("the state's table 'path_values' is cut");
  for (std::size_t i = 0; i < 3; ++i) {
    p.grid.low[i] = static_cast<float>(head[i]);
    p.grid.per_unit[i] = static_cast<float>(head[3 + i]);
    p.grid.size[i] = static_cast<std::int32_t>(head[6 + i]);
    p.channel[i] = static_cast<float>(head[9 + i]);
  }
  p.scale = static_cast<float>(head[12]);
  Put(TableOf(trained, "path_values_survive"), p.survive);
  Put(TableOf(trained, "path_values_split"), p.split);
  // Kernels look cells up without asking.
  const std::size_t cells = p.survive.size();
  if (cells > 0 && (head[6] < 1 || head[7] < 1 || head[8] < 1 ||
                    head[6] * head[7] * head[8] * 6 != double(cells))) {
    throw InputError("the state's table 'path_values_survive' does not fit its grid");
  }
  if (!p.split.empty() && p.split.size() != cells) {
    throw InputError("the state's table 'path_values_split' does not fit its grid");
  }
  Put(TableOf(trained, "path_values_inverse"), p.inverse_pixel);
  // A pilot may have decided on a guide that the scene's strategy does not ask for.
  if (!tables.guide.nodes.empty() || HasTable(trained, "guide_at")) {
    PutGuide(trained, tables.guide);
  }
  for (const TrainedTable& table : trained) {
    if (table.name == kShadowWorth) Put(table.values, tables.shadow_worth.inverse);
  }
}

}  // namespace lanelight
