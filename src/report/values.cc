#include "src/report/values.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

std::string EstimateText(const Interval& v) {
  if (v.HasBounds())
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", v.value, v.low, v.high);
  return std::isnan(v.value) ? "-" : fmt::format("{:.3g}", v.value);
}

}  // namespace lanelight
