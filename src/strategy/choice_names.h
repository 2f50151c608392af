// The texts of the choices, in the order of their enumerators.
#pragma once

#include "src/strategy/choices.h"

namespace lanelight {

#define X(enumerator, own, also, text, ...) text,
inline constexpr const char* kDirections[] = {LANELIGHT_DIRECTIONS(X)};
inline constexpr const char* kPoints[] = {LANELIGHT_POINTS(X)};
inline constexpr const char* kPairs[] = {LANELIGHT_PAIRS(X)};
inline constexpr const char* kControls[] = {LANELIGHT_CONTROLS(X)};
inline constexpr const char* kRoulettes[] = {LANELIGHT_ROULETTES(X)};
inline constexpr const char* kLightSelections[] = {LANELIGHT_LIGHT_SELECTIONS(X)};
inline constexpr const char* kSeenLights[] = {LANELIGHT_SEEN_LIGHTS(X)};
#undef X
#define X(enumerator, text, meaning) text,
inline constexpr const char* kPaired[] = {LANELIGHT_PAIRED(X)};
#undef X
inline constexpr const char* kHeuristics[] = {"power", "balance"};

}  // namespace lanelight
