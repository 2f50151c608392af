// Strategies under the names that studies and sweeps take.
#pragma once

#include <string>

#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

inline constexpr const char* kDefaultStrategyName = "default";
inline constexpr const char* kSceneStrategyName = "scene";

/// "default" is the renderer's, "scene" is `own`, the scene's; anything else, a text for
/// ApplyStrategy, changes the default, so that it is the same for all scenes. Throws
/// InputError at `where` for a text that is not understood.
Strategy StrategyNamed(const std::string& name, const SourceLocation& where,
                       const Strategy& own);

}  // namespace lanelight
