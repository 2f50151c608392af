#include "src/report/csv.h"

#include <nlohmann/json.hpp>

#include "src/core/json_text.h"

namespace lanelight {

std::string CsvField(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return DumpJson(value);
  const auto text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace lanelight
