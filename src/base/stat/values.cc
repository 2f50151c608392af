#include "src/base/stat/values.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"

namespace lanelight {

nlohmann::json NumberJson(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nullptr;
}

nlohmann::json IntervalJson(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return {{"value", NumberJson(interval->value)},
          {"low", NumberJson(interval->low)},
          {"high", NumberJson(interval->high)}};
}

std::string CsvQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string CsvField(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return DumpJson(value);
  const auto text = value.get<std::string>();
  return text.find_first_of(",\"\r\n") == std::string::npos ? text : CsvQuoted(text);
}

std::string EstimateText(const Interval& v) {
  if (v.HasBounds())
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", v.value, v.low, v.high);
  return std::isnan(v.value) ? "-" : fmt::format("{:.3g}", v.value);
}

}  // namespace lanelight
