#include "src/base/stat/values.h"
#include "src/measure/sweep/group_costs.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr const char* kMeans[] = {
    "samples", "render_seconds",  "cpu_seconds",       "relmse",
    "rmse",    "rays_per_second", "samples_per_second"};

Json MeansJson(const CellGroup& group, const std::vector<Json>& cells) {
  Json means = Json::object();
  for (const char* name : kMeans) {
    std::vector<double> values;
    for (const std::size_t i : group.cells) values.push_back(MeasureOf(cells[i], name));
    means[name] = IntervalJson(stat::MeanInterval(values, kSweepConfidence));
  }
  return means;
}

// Returns costs of the baseline by context.
std::map<std::size_t, SeedCosts> BaselineCosts(const std::vector<CellGroup>& groups,
                                               const std::vector<Json>& cells,
                                               const std::string& baseline) {
  std::map<std::size_t, SeedCosts> costs;
  for (const CellGroup& group : groups) {
    if (group.strategy == baseline) costs[group.context] = CostsOf(group, cells);
  }
  return costs;
}

}  // namespace

std::string BaselineOf(const Sweep& sweep) {
  std::string first;
  for (const SweepCell& cell : sweep.cells) {
    const std::string strategy = Get(cell.values, Axis::kStrategy).value_or("");
    if (strategy == kDefaultStrategyName) return strategy;
    if (first.empty()) first = strategy;
  }
  return first;
}

std::vector<CellGroup> GroupCells(const Sweep& sweep, const std::vector<Json>& cells) {
  const std::map<std::string, std::string> scenes = NamesOfScenes(sweep);
  std::vector<CellGroup> groups;
  std::map<std::map<std::string, std::string>, std::size_t> known, contexts;
  for (const SweepCell& cell : sweep.cells) {
    CellGroup group;
    group.values = ByKey(cell.values);
    group.values.erase(Key(Axis::kSeed));
    group.values[Key(Axis::kScene)] = scenes.at(*Get(cell.values, Axis::kScene));
    group.strategy = Get(cell.values, Axis::kStrategy).value_or("");
    group.context = contexts.try_emplace(ContextOf(group), contexts.size()).first->second;
    std::vector<StrategyPlace> places = {{group.strategy, {}}};
    if (const auto found = sweep.places.find(group.strategy);
        found != sweep.places.end()) {
      places = found->second;
    }
    for (const StrategyPlace& place : places) {
      CellGroup one = group;
      if (!place.family.empty()) one.values[Key(Axis::kStrategy)] = place.family;
      one.values.insert(place.parameters.begin(), place.parameters.end());
      const auto [entry, is_new] = known.try_emplace(one.values, groups.size());
      if (is_new) groups.push_back(std::move(one));
      const Json& status = cells[cell.index].at("status");
      CellGroup& all = groups[entry->second];
      if (status == Name(CellState::kDone)) all.cells.push_back(cell.index);
      all.lost |= cells[cell.index].value("lost", false);
      if (const auto within = cells[cell.index].find("within");
          within != cells[cell.index].end()) {
        all.within = within->get<double>();
      }
    }
  }
  return groups;
}

Json GroupsJson(const std::vector<CellGroup>& groups, const std::vector<Json>& cells,
                const std::string& baseline) {
  const auto baselines = BaselineCosts(groups, cells, baseline);
  Json json = Json::array();
  for (const CellGroup& group : groups) {
    if (group.cells.empty()) continue;
    Json one = {
        {"values", group.values}, {"cells", group.cells}, {"efficiency", nullptr}};
    if (!group.strategy.empty()) one["strategy"] = group.strategy;
    if (group.cells.size() > 1) one["measured"] = MeansJson(group, cells);
    const auto base = baselines.find(group.context);
    if (base != baselines.end() && !group.strategy.empty()) {
      const auto pairs = PairedCosts({base->second, CostsOf(group, cells)});
      if (!pairs[0].empty()) {
        one["efficiency"] = IntervalJson(
            group.strategy == baseline
                ? WithoutBounds(1)  // nothing is estimated
                : stat::EfficiencyRatio(pairs[0], pairs[1], kSweepConfidence));
      }
    }
    json.push_back(std::move(one));
  }
  return json;
}

}  // namespace lanelight
