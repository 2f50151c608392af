// Strategies by name, their differences, and the lists of `lanelight strategies`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

inline constexpr const char* kSceneStrategyName = "scene";

/// Returns the renderer's strategy for "default" and `own`, the scene's, for "scene".
/// Otherwise `name` is a text for ApplyStrategy, applied to the default, so that the
/// result is the same for all scenes. Throws InputError at `where` for an invalid text.
Strategy StrategyNamed(const std::string& name, const SourceLocation& where,
                       const Strategy& own);

/// Returns the choices of `text` that differ from those of `other`, both complete text
/// forms (ToText): "roulette=none,reuse=block:32:random"; empty if both are the same.
std::string ChoicesNotIn(std::string_view other, std::string_view text);

/// Returns the lists of `lanelight strategies`, as "choices": axis, name, arguments,
/// meaning, formula, source of each; "presets": name, meaning, complete strategy;
/// "default": the renderer's strategy.
nlohmann::json StrategiesJson();

}  // namespace lanelight
