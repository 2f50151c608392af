#include "src/measure/sweep/race.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/measure/sweep/results.h"
#include "src/render/estimate/estimate.h"

namespace lanelight {
namespace {

constexpr double kMinSeconds = 1e-9;

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

std::optional<double> Race::Within(std::size_t cell) const {
  return contexts_[context_of_[cell]].result.within;
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
    json["message"] = "the race is decided (--race)";
    if (json["lost"]) {
      json["message"] = "clearly less efficient than the best (--race)";
    } else if (const auto within = race.Within(cell.index)) {
      json["within"] = *within;
      json["message"] = "more seeds would hardly decide between the best (--race)";
    }
    ++stopped;
  }
  return stopped;
}

}  // namespace lanelight
