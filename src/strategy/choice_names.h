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
inline constexpr const char* kLightPoints[] = {LANELIGHT_LIGHT_POINTS(X)};
inline constexpr const char* kLightCandidateChoices[] = {
    LANELIGHT_LIGHT_CANDIDATE_CHOICES(X)};
inline constexpr const char* kEnvironmentPoints[] = {LANELIGHT_ENVIRONMENT_CHOICES(X)};
inline constexpr const char* kShadowRoulettes[] = {LANELIGHT_SHADOW_ROULETTES(X)};
inline constexpr const char* kDistances[] = {LANELIGHT_DISTANCES(X)};
inline constexpr const char* kGuidings[] = {LANELIGHT_GUIDINGS(X)};
inline constexpr const char* kReuses[] = {LANELIGHT_REUSES(X)};
inline constexpr const char* kDecisions[] = {LANELIGHT_DECISIONS(X)};
#undef X
#define X(enumerator, text, meaning) text,
inline constexpr const char* kPaired[] = {LANELIGHT_PAIRED(X)};
inline constexpr const char* kBlockLayouts[] = {LANELIGHT_BLOCK_LAYOUTS(X)};
#undef X
inline constexpr const char* kHeuristics[] = {"power", "balance"};

}  // namespace lanelight
