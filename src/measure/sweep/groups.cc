#include "src/measure/sweep/results.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "src/base/stat/efficiency.h"
#include "src/base/stat/hypothesis.h"
#include "src/base/stat/values.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;
using Costs = std::map<std::string, stat::Cost>;  // by seed

constexpr double kSweepConfidence = 0.95;  // of all intervals over seeds

constexpr const char* kMeans[] = {
    "samples", "render_seconds",  "cpu_seconds",       "relmse",
    "rmse",    "rays_per_second", "samples_per_second"};
// Ranking takes a bootstrap for every pair.
constexpr std::size_t kMaxRanked = 64;

double MeasureOf(const Json& cell, const char* name) {
  const Json value = cell.at("measured").value(name, Json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

// Returns the cost of a cell. The error of one that renders for a time falls with the
// processor time that it got, so that only the product of both tells its efficiency.
stat::Cost CostOf(const Json& cell) {
  const stat::Cost cost = {MeasureOf(cell, "relmse"), MeasureOf(cell, "cpu_seconds")};
  const bool timed = cell.at("values").contains(Key(Axis::kTime));
  return timed ? stat::Cost{cost.error * cost.seconds, 1} : cost;
}

// Returns the costs of cells with a known error.
Costs CostsOf(const CellGroup& group, const std::vector<Json>& cells) {
  Costs costs;
  for (const std::size_t i : group.cells) {
    const stat::Cost cost = CostOf(cells[i]);
    if (!std::isfinite(cost.error) || !std::isfinite(cost.seconds)) continue;
    costs[cells[i].at("values").value(Key(Axis::kSeed), "")] = cost;
  }
  return costs;
}

// Returns the repetitions of each, for seeds that all have.
std::vector<std::vector<stat::Cost>> PairedCosts(const std::vector<Costs>& all) {
  std::vector<std::vector<stat::Cost>> paired(all.size());
  for (const auto& [seed, unused] : all[0]) {
    if (std::ranges::any_of(all, [&](const Costs& c) { return c.count(seed) == 0; })) {
      continue;
    }
    for (std::size_t i = 0; i < all.size(); ++i) paired[i].push_back(all[i].at(seed));
  }
  return paired;
}

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
std::map<std::size_t, Costs> BaselineCosts(const std::vector<CellGroup>& groups,
                                           const std::vector<Json>& cells,
                                           const std::string& baseline) {
  std::map<std::size_t, Costs> costs;
  for (const CellGroup& group : groups) {
    if (group.strategy == baseline) costs[group.context] = CostsOf(group, cells);
  }
  return costs;
}

struct StrategyCosts {
  std::string strategy;
  Costs costs;
};

// The strategies of a context. Those that stopped (--race) have fewer seeds.
struct Contest {
  std::vector<StrategyCosts> ranked, stopped;
  const CellGroup* sample = nullptr;

  // Returns null if no group has entered it.
  const StrategyCosts* Find(const std::string& strategy) const {
    for (const auto* strategies : {&ranked, &stopped}) {
      for (const StrategyCosts& c : *strategies) {
        if (c.strategy == strategy) return &c;
      }
    }
    return nullptr;
  }
};

// A strategy and its efficiency relative to the baseline.
struct Placed {
  std::string strategy;
  Interval efficiency = WithoutBounds(0);
};

// Returns an efficiency relative to the baseline, by the seeds that both have; without
// any, the value is NaN.
Interval RatioOf(const Costs& baseline, const Costs& costs, double confidence) {
  const auto paired = PairedCosts({baseline, costs});
  if (paired[0].empty()) return WithoutBounds(std::nan(""));
  return stat::EfficiencyRatio(paired[0], paired[1], confidence);
}

// Returns the most efficient strategy but `best`; an empty name without any. Those that
// stopped have fewer seeds.
Placed RunnerUp(const Contest& contest, const StrategyCosts& best, const Costs& baseline,
                double confidence) {
  Placed next;
  for (const auto* strategies : {&contest.ranked, &contest.stopped}) {
    for (const StrategyCosts& c : *strategies) {
      const Interval efficiency = RatioOf(baseline, c.costs, confidence);
      if (&c == &best || std::isnan(efficiency.value)) continue;
      if (next.strategy.empty() || efficiency.value > next.efficiency.value) {
        next = {c.strategy, efficiency};
      }
    }
  }
  return next;
}

Json LeaderJson(const Contest& contest, const std::string& baseline) {
  const std::vector<StrategyCosts>& strategies = contest.ranked;
  std::vector<Costs> all;
  for (const StrategyCosts& c : strategies) all.push_back(c.costs);
  const auto paired = PairedCosts(all);
  if (paired[0].empty()) return nullptr;
  const StrategyCosts* base = contest.Find(baseline);
  if (base == nullptr) base = &strategies[0];
  const int others = std::max(1, int(all.size() + contest.stopped.size()) - 1);
  const double confidence = 1 - stat::SidakLevel(1 - kSweepConfidence, others);
  std::size_t at = 0;
  double highest = 0;
  for (std::size_t i = 0; i < paired.size(); ++i) {
    const double ratio = stat::EfficiencyRatio(paired[0], paired[i], confidence).value;
    if (ratio > highest) at = i, highest = ratio;
  }
  const StrategyCosts& best = strategies[at];
  const Placed next = RunnerUp(contest, best, base->costs, confidence);
  const Interval efficiency =
      &best == base ? WithoutBounds(1) : RatioOf(base->costs, best.costs, confidence);
  if (std::isnan(efficiency.value)) return nullptr;
  Json json = {{"best", best.strategy},
               {"baseline", base->strategy},
               {"efficiency", IntervalJson(efficiency)},
               {"next", next.strategy.empty() ? Json() : Json(next.strategy)},
               {"next_efficiency", IntervalJson(next.efficiency)},
               {"strategies", all.size()},
               {"stopped", contest.stopped.size()},
               {"seeds", paired[0].size()},
               {"equals", nullptr}};
  if (all.size() > kMaxRanked) return json;
  const auto ranks = stat::RankByEfficiency(paired, kSweepConfidence);
  json["equals"] =
      std::ranges::count_if(ranks, [](const stat::RankRange& r) { return r.best == 1; }) -
      (ranks[at].best == 1);
  return json;
}

// Returns the values of a group that do not belong to its strategy.
std::map<std::string, std::string> ContextOf(const CellGroup& group) {
  std::map<std::string, std::string> values;
  for (const auto& [axis, value] : group.values) {
    const bool strategy = axis == Key(Axis::kStrategy) || !AxisOfKey(axis);
    if (!strategy) values[axis] = value;
  }
  return values;
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

Json LeadersJson(const std::vector<CellGroup>& groups, const std::vector<Json>& cells,
                 const std::string& baseline) {
  std::map<std::size_t, Contest> contexts;
  for (const CellGroup& group : groups) {
    Contest& contest = contexts[group.context];
    Costs costs = CostsOf(group, cells);
    if (contest.Find(group.strategy) != nullptr) continue;
    if (group.lost) {
      contest.stopped.push_back({group.strategy, std::move(costs)});
    } else if (!costs.empty()) {
      contest.ranked.push_back({group.strategy, std::move(costs)});
      contest.sample = &group;
    }
  }
  std::map<std::string, Json> last;  // by scene
  std::vector<std::string> order;
  for (const auto& [context, contest] : contexts) {
    if (contest.ranked.size() + contest.stopped.size() < 2 || contest.ranked.empty()) {
      continue;
    }
    Json leader = LeaderJson(contest, baseline);
    if (leader.is_null()) continue;
    leader["values"] = ContextOf(*contest.sample);
    const std::string scene = leader["values"].at(Key(Axis::kScene));
    if (last.count(scene) == 0) order.push_back(scene);
    last[scene] = std::move(leader);
  }
  Json json = Json::array();
  for (const std::string& scene : order) json.push_back(last[scene]);
  return json;
}

}  // namespace lanelight
