#include "src/render/job/machine_json.h"

#include <OpenEXRConfig.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "kernels/simd/target.h"
#include "src/base/core/parallel.h"
#include "src/base/core/version.h"
#include "src/base/stat/values.h"
#include "src/render/job/report.h"

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

std::string TargetText(const std::string& target) {
  return target + (target.starts_with("AVX3") ? " (AVX-512)" : "");
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

std::vector<std::pair<std::string, std::string>> LibraryVersions() {
  return {{"lanelight", Version()},
          {"commit", Commit()},
          {"compiler", Compiler()},
          {"highway", HighwayVersion()},
          {"onetbb", TbbVersion()},
          {"openexr", OPENEXR_VERSION_STRING},
          {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                              FMT_VERSION % 100)},
          {"nlohmann_json",
           fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                       NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

}  // namespace lanelight
