// Numbers and intervals as reports and tables have them, for programs and for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "src/base/stat/interval.h"

namespace lanelight {

/// Null for what is not known, or not finite.
nlohmann::json NumberJson(double value);

/// "value", "low" and "high"; null for none.
nlohmann::json IntervalJson(const std::optional<Interval>& interval);

/// A text in quotes, as RFC 4180 has it.
std::string CsvQuoted(const std::string& text);
/// A value, likewise: a text in quotes if it must be; null is empty.
std::string CsvField(const nlohmann::json& value);

/// "1.23 [1.1, 1.4]"; without bounds "1.23", and "-" where that is not known.
std::string EstimateText(const Interval& interval);

}  // namespace lanelight
