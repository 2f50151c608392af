#include "src/sweep/sweep_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "src/render/machine_json.h"
#include "src/report/page.h"
#include "src/sweep/results.h"
#include "src/sweep/sweep_folder.h"

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
  return {{"name", Key(axis)},
          {"title", Title(axis)},
          {"numeric",
           FormOf(axis) == ValueForm::kInteger || FormOf(axis) == ValueForm::kNumber},
          {"values", values},
          {"unset", unset}};
}

Json MachinesJson(const std::vector<Json>& cells) {
  std::vector<MachineInfo> machines;
  for (const Json& cell : cells) {
    if (cell.at("status") != Name(CellState::kDone)) continue;
    AddMachine(MachineFromJson(cell.at("machine")), machines);
  }
  return ToJson(machines);
}

// Ten thousand cells fit into a page: stages are numbers of four digits without names.
Json PageCell(const Json& cell, const std::vector<std::string>& stage_names) {
  Json json = {{"name", cell.at("name")},       {"status", cell.at("status")},
               {"message", cell.at("message")}, {"values", cell.at("values")},
               {"measured", Json::object()},    {"stages", Json::array()}};
  for (const auto& [name, value] : cell.at("measured").items()) {
    if (IsOnPage(name)) json["measured"][name] = value;
  }
  for (const std::string& name : stage_names) {
    const auto stage = cell.at("stages").find(name);
    if (stage == cell.at("stages").end()) {
      json["stages"].push_back(nullptr);
    } else {
      const double seconds = stage->get<double>();
      json["stages"].push_back(std::stod(fmt::format("{:.4g}", seconds)));
    }
  }
  return json;
}

}  // namespace

Json SweepJson(const Sweep& sweep, const std::vector<Json>& cells) {
  Json axes = Json::array();
  for (const Axis axis : sweep.UsedAxes()) axes.push_back(AxisJson(sweep, axis));
  const std::vector<std::string> stages = StageNames(cells);
  Json page_cells = Json::array();
  for (const Json& cell : cells) page_cells.push_back(PageCell(cell, stages));
  return {{"schema", 1},
          {"kind", "lanelight-sweep"},
          {"file", sweep.path},
          {"settings", sweep.settings.texts},
          {"excluded", sweep.excluded},
          {"axes", axes},
          {"stages", stages},
          {"machines", MachinesJson(cells)},
          {"cells", page_cells}};
}

std::string SweepPage(const Sweep& sweep, const std::vector<Json>& cells) {
  return SweepReportPage(SweepJson(sweep, cells));
}

}  // namespace lanelight
