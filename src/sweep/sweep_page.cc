#include "src/sweep/sweep_page.h"

#include <nlohmann/json.hpp>
#include <set>

#include "src/report/page.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Values of an axis in the order of the grid.
Json AxisJson(const Sweep& sweep, Axis axis) {
  Json values = Json::array();
  std::set<std::string> seen;
  bool unset = false;
  for (const SweepCell& cell : sweep.cells) {
    const auto& value = Get(cell.values, axis);
    unset |= !value.has_value();
    if (value && seen.insert(*value).second) values.push_back(*value);
  }
  return {{"name", Name(axis)},
          {"title", Title(axis)},
          {"numeric", TypeOf(axis) != AxisType::kText},
          {"values", values},
          {"unset", unset}};
}

}  // namespace

Json SweepJson(const Sweep& sweep, const std::vector<Json>& cells) {
  Json axes = Json::array();
  for (const Axis axis : sweep.UsedAxes()) axes.push_back(AxisJson(sweep, axis));
  return {{"schema", 1},
          {"kind", "lanelight-sweep"},
          {"file", sweep.path},
          {"settings", sweep.settings.texts},
          {"excluded", sweep.excluded},
          {"axes", axes},
          {"cells", cells}};
}

std::string SweepPage(const Sweep& sweep, const std::vector<Json>& cells) {
  return SweepReportPage(SweepJson(sweep, cells));
}

}  // namespace lanelight
