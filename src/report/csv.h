// Tables for other programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lanelight {

/// A value as RFC 4180 has it: a text in quotes if it must be; null is empty.
std::string CsvField(const nlohmann::json& value);

}  // namespace lanelight
