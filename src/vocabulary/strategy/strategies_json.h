// The lists that `lanelight strategies` prints, for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lanelight {

/// Returns "choices": axis, name, arguments, meaning, formula, source of each; "presets":
/// name, meaning, complete strategy; "default": the renderer's strategy.
nlohmann::json StrategiesJson();

}  // namespace lanelight
