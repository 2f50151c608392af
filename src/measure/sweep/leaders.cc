// The most efficient strategies of a sweep.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "src/base/stat/hypothesis.h"
#include "src/base/stat/values.h"
#include "src/measure/sweep/group_costs.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;
using PairedStrategies = std::vector<std::vector<stat::Cost>>;

// Ranking takes a bootstrap for every pair.
constexpr std::size_t kMaxRanked = 64;

struct StrategyCosts {
  std::string strategy;
  SeedCosts costs;
};

// The strategies of a context. Strategies that stopped (--race) have fewer seeds.
struct Contest {
  std::vector<StrategyCosts> ranked, stopped;
  const CellGroup* sample = nullptr;
  std::optional<double> within;  // CellGroup::within

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
Interval RatioOf(const SeedCosts& baseline, const SeedCosts& costs, double confidence) {
  const auto paired = PairedCosts({baseline, costs});
  if (paired[0].empty()) return WithoutBounds(std::nan(""));
  return stat::EfficiencyRatio(paired[0], paired[1], confidence);
}

// Returns the most efficient strategy but `best`; an empty name without any. Strategies
// that stopped have fewer seeds.
Placed RunnerUp(const Contest& contest, const StrategyCosts& best,
                const SeedCosts& baseline, double confidence) {
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

// Strategies that may be the most efficient.
struct Undecided {
  std::vector<std::size_t> strategies;  // the best by its mean first
  /// Largest extra time that they may need for the error of the best, as a fraction.
  std::optional<double> within;
};

// Returns the strategies with the most efficient first.
std::vector<std::size_t> ByEfficiency(const PairedStrategies& paired, double confidence) {
  std::vector<double> ratios;
  std::vector<std::size_t> order;
  for (const std::vector<stat::Cost>& costs : paired) {
    order.push_back(order.size());
    ratios.push_back(stat::EfficiencyRatio(paired[0], costs, confidence).value);
  }
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(-ratios[i], i); });
  return order;
}

// Keeps of an order by efficiency what may be the best by the intervals of all pairs.
Undecided FindUndecided(const PairedStrategies& paired,
                        const std::vector<std::size_t>& order, double confidence) {
  const auto ranks = stat::RankByEfficiency(paired, kSweepConfidence);
  Undecided out;
  double within = 0;
  for (const std::size_t i : order) {
    if (i != order[0] && ranks[i].best > 1) continue;
    out.strategies.push_back(i);
    if (i == order[0]) continue;
    const Interval excess =
        stat::EfficiencyRatio(paired[i], paired[order[0]], confidence);
    within = std::max(within, excess.HasBounds() ? excess.high - 1 : INFINITY);
  }
  if (paired[0].size() >= kMinRankedSeeds && std::isfinite(within)) out.within = within;
  return out;
}

Json LeaderJson(const Contest& contest, const std::string& baseline) {
  const std::vector<StrategyCosts>& strategies = contest.ranked;
  std::vector<SeedCosts> all;
  for (const StrategyCosts& c : strategies) all.push_back(c.costs);
  const PairedStrategies paired = PairedCosts(all);
  if (paired[0].empty()) return nullptr;
  const StrategyCosts* base = contest.Find(baseline);
  if (base == nullptr) base = &strategies[0];
  const int others = std::max(1, int(all.size() + contest.stopped.size()) - 1);
  const double confidence = 1 - stat::SidakLevel(1 - kSweepConfidence, others);
  Undecided open = {ByEfficiency(paired, confidence), contest.within};
  const StrategyCosts& best = strategies[open.strategies[0]];
  const Placed next = RunnerUp(contest, best, base->costs, confidence);
  const Interval efficiency =
      &best == base ? WithoutBounds(1) : RatioOf(base->costs, best.costs, confidence);
  if (std::isnan(efficiency.value)) return nullptr;
  const bool is_tested = contest.within.has_value() || all.size() <= kMaxRanked;
  if (!contest.within && is_tested) {
    open = FindUndecided(paired, open.strategies, confidence);
  }
  Json json = {{"best", best.strategy},
               {"baseline", base->strategy},
               {"efficiency", IntervalJson(efficiency)},
               {"next", next.strategy.empty() ? Json() : Json(next.strategy)},
               {"next_efficiency", IntervalJson(next.efficiency)},
               {"strategies", all.size()},
               {"stopped", contest.stopped.size()},
               {"seeds", paired[0].size()},
               {"equals", nullptr},
               {"undecided", Json::array()},
               {"within", nullptr}};
  if (!is_tested) return json;
  json["equals"] = open.strategies.size() - 1;
  if (open.strategies.size() == 1) return json;
  for (const std::size_t i : open.strategies) {
    json["undecided"].push_back(strategies[i].strategy);
  }
  if (open.within) json["within"] = *open.within;
  return json;
}

}  // namespace

Json LeadersJson(const std::vector<CellGroup>& groups, const std::vector<Json>& cells,
                 const std::string& baseline) {
  std::map<std::size_t, Contest> contexts;
  for (const CellGroup& group : groups) {
    Contest& contest = contexts[group.context];
    if (group.within) contest.within = group.within;
    SeedCosts costs = CostsOf(group, cells);
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
