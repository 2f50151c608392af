#include "src/measure/sweep/race.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/measure/sweep/results.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

// Levels of any wrong stop at the first look, and at the others.
constexpr double kFirstLevel = 0.01, kLevel = 0.04;
// Degrees of freedom that the pooled variance counts at most, beside a strategy's own.
constexpr double kMaxPooledDof = 8;
constexpr double kMinSeconds = 1e-9;

// The strategies that have not stopped, at a look.
class Look {
 public:
  Look(const std::vector<Racer>& racers, const std::vector<std::size_t>& alive,
       std::size_t seeds)
      : alive_(alive), seeds_(double(seeds)), means_(alive.size()), own_(alive.size()) {
    std::vector<double> of_seed(seeds);
    for (std::size_t i = 0; i < alive.size(); ++i) {
      for (std::size_t s = 0; s < seeds; ++s) {
        const double cost = racers[alive[i]].log_costs[s];
        means_[i] += cost / seeds_;
        of_seed[s] += cost / double(alive.size());
      }
      mean_ += means_[i] / double(alive.size());
    }
    for (std::size_t i = 0; i < alive.size(); ++i) {
      for (std::size_t s = 0; s < seeds; ++s) {
        const double cost = racers[alive[i]].log_costs[s];
        const double rest = cost - means_[i] - of_seed[s] + mean_;
        own_[i] += rest * rest;
      }
      all_ += own_[i];
    }
    best_ = std::size_t(std::ranges::min_element(means_) - means_.begin());
  }

  // Appends the strategies that are worse than the best at this level.
  void FindWorse(double level, std::vector<std::size_t>& worse) const {
    const double others = double(alive_.size()) - 1;
    const double pooled_dof = others * (seeds_ - 1);
    const double prior = std::min(pooled_dof, kMaxPooledDof);
    const double dof = prior + seeds_ - 1;
    // Residuals of a strategy have lost a share of its variance to the seeds' means.
    const double share = others / double(alive_.size());
    const auto variance = [&](std::size_t i) {
      return (prior * all_ / pooled_dof + own_[i] / share) / dof;
    };
    const double quantile = stat::StudentTwoSidedQuantile(2 * level, dof);
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (i == best_) continue;
      const double error = std::sqrt((variance(i) + variance(best_)) / seeds_);
      if (means_[i] - means_[best_] > quantile * error) worse.push_back(alive_[i]);
    }
  }

 private:
  const std::vector<std::size_t>& alive_;
  const double seeds_;
  std::vector<double> means_, own_;  // own: sums of squared residuals
  double mean_ = 0, all_ = 0;
  std::size_t best_ = 0;
};

// Appends the strategies that are worse than the best by their first costs.
void FindWorseByFirst(const std::vector<Racer>& racers,
                      const std::vector<std::size_t>& alive, double level,
                      std::vector<std::size_t>& worse) {
  const auto cost = [&](std::size_t i) { return racers[i].log_costs[0]; };
  const std::size_t best = *std::ranges::min_element(alive, {}, cost);
  const double quantile = stat::NormalQuantile(1 - level);
  for (const std::size_t i : alive) {
    const double error = std::hypot(racers[i].deviation, racers[best].deviation,
                                    std::sqrt(2.0) * kTimeDeviation);
    if (i != best && cost(i) - cost(best) > quantile * error) worse.push_back(i);
  }
}

bool HaveSeeds(const std::vector<Racer>& racers, const std::vector<std::size_t>& which,
               std::size_t seeds) {
  return std::ranges::all_of(which, [&](std::size_t i) {
    const std::vector<double>& costs = racers[i].log_costs;
    return costs.size() >= seeds &&
           std::all_of(costs.begin(), costs.begin() + long(seeds),
                       [](double c) { return std::isfinite(c); });
  });
}

// Enters a finished cell; an unknown cost is NaN, and ends the looks of its race.
void EnterCell(Race& race, const SweepCell& cell, const nlohmann::json& json) {
  const auto number = [&](const char* name) {
    const nlohmann::json value = json.at("measured").value(name, nlohmann::json());
    return value.is_number() ? value.get<double>() : NAN;
  };
  race.Enter(cell.index, {number("relmse"), number("relmse_low"), number("relmse_high")},
             number("cpu_seconds"));
}

}  // namespace

RaceResult StopsOf(const std::vector<Racer>& racers, std::size_t seeds) {
  const std::size_t n = racers.size();
  RaceResult result = {std::vector<std::size_t>(n, seeds), std::vector<bool>(n)};
  if (n < 2) return result;
  double level = kLevel / (double(n) - 1);
  for (std::size_t look = 1; look < seeds; ++look) {
    std::vector<std::size_t> alive, worse;
    for (std::size_t i = 0; i < n; ++i) {
      if (!result.lost[i]) alive.push_back(i);
    }
    if (!HaveSeeds(racers, alive, look)) break;
    if (look == 1) {
      FindWorseByFirst(racers, alive, kFirstLevel / (double(n) - 1), worse);
    } else {
      level /= 2;
      Look(racers, alive, look).FindWorse(level, worse);
    }
    const std::size_t enough = std::min<std::size_t>(kMinRankedSeeds, seeds);
    for (const std::size_t i : worse) {
      result.lost[i] = true;
      result.stops[i] = racers[i].stays ? std::max(look, enough) : look;
    }
    if (worse.size() + 1 < alive.size()) continue;
    const auto winner = std::ranges::find(result.lost, false) - result.lost.begin();
    result.stops[std::size_t(winner)] = std::max(look, enough);
    break;
  }
  return result;
}

Race::Race(const Sweep& sweep) : entered_(sweep.cells.size()) {
  const std::string baseline = BaselineOf(sweep);
  std::map<std::string, std::size_t> round_of;
  std::map<AxisValues, std::size_t> context_of;
  for (const SweepCell& cell : sweep.cells) {
    AxisValues values = cell.values;
    auto& seed = values[std::size_t(Axis::kSeed)];
    auto& strategy = values[std::size_t(Axis::kStrategy)];
    const std::string seed_text = seed.value_or(""), name = strategy.value_or("");
    seed.reset();
    strategy.reset();
    rounds_.push_back(round_of.try_emplace(seed_text, round_of.size()).first->second);
    context_of_.push_back(context_of.try_emplace(values, contexts_.size()).first->second);
    if (context_of_.back() == contexts_.size()) contexts_.emplace_back();
    Context& context = contexts_[context_of_.back()];
    context.cells.push_back(cell.index);
    const auto [racer, is_new] =
        context.racer_of.try_emplace(name, context.racers.size());
    if (is_new) context.racers.emplace_back().stays = name == baseline;
    racer_of_.push_back(racer->second);
  }
  seeds_ = round_of.size();
  for (Context& context : contexts_) {
    context.costs.resize(context.racers.size());
    context.result = StopsOf(context.racers, seeds_);
  }
}

void Race::Enter(std::size_t cell, const Interval& error, double seconds) {
  if (entered_[cell]) return;
  entered_[cell] = true;
  Context& context = contexts_[context_of_[cell]];
  const double cost = std::log(error.value) + std::log(std::max(seconds, kMinSeconds));
  context.costs[racer_of_[cell]][rounds_[cell]] = cost;
  if (rounds_[cell] == 0) {
    const double width = std::log(error.high / error.low);
    context.racers[racer_of_[cell]].deviation =
        width / 2 / stat::NormalQuantile((1 + kEstimateConfidence) / 2);
  }
  Update(context);
}

// The costs of a strategy end before its first seed that is missing.
void Race::Update(Context& context) const {
  for (std::size_t i = 0; i < context.racers.size(); ++i) {
    std::vector<double>& costs = context.racers[i].log_costs;
    costs.clear();
    for (const auto& [round, cost] : context.costs[i]) {
      if (round != costs.size()) break;
      costs.push_back(cost);
    }
  }
  context.result = StopsOf(context.racers, seeds_);
}

const std::vector<std::size_t>& Race::Rivals(std::size_t cell) const {
  return contexts_[context_of_[cell]].cells;
}

bool Race::IsStopped(std::size_t cell) const {
  return rounds_[cell] >= contexts_[context_of_[cell]].result.stops[racer_of_[cell]];
}

bool Race::HasLost(std::size_t cell) const {
  return contexts_[context_of_[cell]].result.lost[racer_of_[cell]];
}

void EnterIfDone(Race& race, SweepFolder& folder, const SweepCell& cell) {
  const CellRecord record = folder.ReadCell(cell);
  if (record.state == CellState::kDone) EnterCell(race, cell, CellJson(cell, record));
}

std::size_t MarkStopped(const Sweep& sweep, std::vector<nlohmann::json>& cells) {
  Race race(sweep);
  for (const SweepCell& cell : sweep.cells) {
    const nlohmann::json& json = cells[cell.index];
    if (json.at("status") == Name(CellState::kDone)) EnterCell(race, cell, json);
  }
  std::size_t stopped = 0;
  for (const SweepCell& cell : sweep.cells) {
    nlohmann::json& json = cells[cell.index];
    if (json.at("status") != Name(CellState::kMissing)) continue;
    if (!race.IsStopped(cell.index)) continue;
    json["status"] = Name(CellState::kStopped);
    json["lost"] = race.HasLost(cell.index);
    json["message"] = json["lost"] ? "clearly less efficient than the best (--race)"
                                   : "the race is decided (--race)";
    ++stopped;
  }
  return stopped;
}

}  // namespace lanelight
