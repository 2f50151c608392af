// Numbers and intervals as reports have them, for programs and for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "src/stat/interval.h"

namespace lanelight {

/// Null for what is not known, or not finite.
nlohmann::json NumberJson(double value);

/// "value", "low" and "high"; null for none.
nlohmann::json IntervalJson(const std::optional<Interval>& interval);

/// "1.23 [1.1, 1.4]"; without bounds "1.23", and "-" where that is not known.
std::string EstimateText(const Interval& interval);

}  // namespace lanelight
