// Strategies under the names that studies and sweeps take.
#pragma once

#include <string>

#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

inline constexpr const char* kDefaultStrategyName = "default";
inline constexpr const char* kSceneStrategyName = "scene";

/// Returns the renderer's strategy for "default" and `own`, the scene's, for "scene".
/// Otherwise `name` is a text for ApplyStrategy, applied to the default, so that the
/// result is the same for all scenes. Throws InputError at `where` for an invalid text.
Strategy StrategyNamed(const std::string& name, const SourceLocation& where,
                       const Strategy& own);

}  // namespace lanelight
