// A machine in reports, and in tables: whoever writes a throughput names it by these.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/core/machine_info.h"

namespace lanelight {

/// Its members by name, null where unknown, and `text`, which MachineText() makes of
/// them.
nlohmann::json ToJson(const MachineInfo& machine);
nlohmann::json ToJson(const std::vector<MachineInfo>& machines);

/// The way back takes what it finds; from null, nothing is known.
MachineInfo MachineFromJson(const nlohmann::json& json);

/// Names of a table's columns and values for them, separated by commas; what is unknown
/// is empty.
std::string MachineCsvHeader();
std::string MachineCsvRow(const MachineInfo& machine);

}  // namespace lanelight
