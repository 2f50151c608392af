#include "src/measure/sweep/group_costs.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Returns the cost of a cell. The error of one that renders for a time falls with the
// processor time that it got, so that only the product of both tells its efficiency.
stat::Cost CostOf(const Json& cell) {
  const stat::Cost cost = {MeasureOf(cell, "relmse"), MeasureOf(cell, "cpu_seconds")};
  const bool timed = cell.at("values").contains(Key(Axis::kTime));
  return timed ? stat::Cost{cost.error * cost.seconds, 1} : cost;
}

}  // namespace

double MeasureOf(const Json& cell, const char* name) {
  const Json value = cell.at("measured").value(name, Json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

SeedCosts CostsOf(const CellGroup& group, const std::vector<Json>& cells) {
  SeedCosts costs;
  for (const std::size_t i : group.cells) {
    const stat::Cost cost = CostOf(cells[i]);
    if (!std::isfinite(cost.error) || !std::isfinite(cost.seconds)) continue;
    costs[cells[i].at("values").value(Key(Axis::kSeed), "")] = cost;
  }
  return costs;
}

std::vector<std::vector<stat::Cost>> PairedCosts(const std::vector<SeedCosts>& all) {
  std::vector<std::vector<stat::Cost>> paired(all.size());
  for (const auto& [seed, unused] : all[0]) {
    if (std::ranges::any_of(all,
                            [&](const SeedCosts& c) { return c.count(seed) == 0; })) {
      continue;
    }
    for (std::size_t i = 0; i < all.size(); ++i) paired[i].push_back(all[i].at(seed));
  }
  return paired;
}

std::map<std::string, std::string> ContextOf(const CellGroup& group) {
  std::map<std::string, std::string> values;
  for (const auto& [axis, value] : group.values) {
    const bool strategy = axis == Key(Axis::kStrategy) || !AxisOfKey(axis);
    if (!strategy) values[axis] = value;
  }
  return values;
}

}  // namespace lanelight
