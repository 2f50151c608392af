// Machines and library versions in reports and tables.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "src/base/core/machine_info.h"

namespace lanelight {

/// Returns the members by name, null where unknown, and `text` (MachineText).
nlohmann::json ToJson(const MachineInfo& machine);
nlohmann::json ToJson(const std::vector<MachineInfo>& machines);

/// Reads the members that are present; null: nothing is known.
MachineInfo MachineFromJson(const nlohmann::json& json);

/// Return column names and values of a table, separated by commas; unknown values are
/// empty.
std::string MachineCsvHeader();
std::string MachineCsvRow(const MachineInfo& machine);

/// Returns the name of a SIMD target, with the instruction set where Highway names that
/// differently: "AVX3 (AVX-512)".
std::string TargetText(const std::string& target);

/// Name and version of the libraries in use, and of the compiler.
std::vector<std::pair<std::string, std::string>> LibraryVersions();

}  // namespace lanelight
