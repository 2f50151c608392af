#include "src/render/job/machine_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "src/base/stat/values.h"

namespace lanelight {

nlohmann::json ToJson(const MachineInfo& machine) {
  nlohmann::json json = {{"text", MachineText(machine)}};
#define X(type, name) \
  json[#name] = machine.name ? nlohmann::json(*machine.name) : nullptr;
  LANELIGHT_MACHINE(X)
#undef X
  return json;
}

nlohmann::json ToJson(const std::vector<MachineInfo>& machines) {
  nlohmann::json json = nlohmann::json::array();
  for (const MachineInfo& machine : machines) json.push_back(ToJson(machine));
  return json;
}

MachineInfo MachineFromJson(const nlohmann::json& json) {
  MachineInfo machine;
#define X(type, name)                                             \
  if (const auto found = json.find(#name); found != json.end()) { \
    if (!found->is_null()) machine.name = found->get<type>();     \
  }
  LANELIGHT_MACHINE(X)
#undef X
  return machine;
}

std::string MachineCsvHeader() {
  std::string text;
#define X(type, name) \
  text += (text.empty() ? "machine_" : ",machine_") + std::string(#name);
  LANELIGHT_MACHINE(X)
#undef X
  return text;
}

std::string MachineCsvRow(const MachineInfo& machine) {
  const nlohmann::json json = ToJson(machine);
  std::string text;
  bool first = true;
#define X(type, name) \
  text += (std::exchange(first, false) ? "" : ",") + CsvField(json[#name]);
  LANELIGHT_MACHINE(X)
#undef X
  return text;
}

}  // namespace lanelight
