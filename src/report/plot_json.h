// Numbers and names in the JSON of what can be drawn.
#pragma once

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/core/error.h"
#include "src/core/suggest.h"
#include "src/report/plot.h"

namespace lanelight {

inline double NumberOf(const nlohmann::json& json) {
  return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// Of {"value", "low", "high"}, a number, or null.
inline Interval IntervalOf(const nlohmann::json& json) {
  if (!json.is_object()) return WithoutBounds(NumberOf(json));
  return {NumberOf(json.at("value")), NumberOf(json.value("low", nlohmann::json())),
          NumberOf(json.value("high", nlohmann::json()))};
}

/// The scene that is to be drawn, of those that `path` has: `name`, which may be empty
/// where there is one. Throws InputError.
inline std::string ChosenScene(const std::vector<std::string>& names,
                               const std::string& path, const std::string& name) {
  if (names.empty()) throw InputError(fmt::format("'{}' has no scene to draw", path));
  for (const std::string& known : names) {
    if (known == name) return name;
  }
  if (!name.empty()) {
    ThrowUnknown({std::make_shared<const std::string>(path)}, "scene", name, names);
  }
  if (names.size() > 1) {
    throw InputError(fmt::format("'{}' has several scenes; choose one by --scene: {}",
                                 path, QuotedList(names)));
  }
  return names.front();
}

}  // namespace lanelight
