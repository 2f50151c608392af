// The texts of the choices, in the order of their enumerators: kDirectionsNames, ...
#pragma once

#include "src/vocabulary/strategy/choices.h"

namespace lanelight {

#define X(enumerator, own, also, text, ...) text,
#define LANELIGHT_AXIS(Type, member, key, CHOICES) \
  inline constexpr const char* k##Type##Names[] = {CHOICES(X)};
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
#undef X
#define X(enumerator, text, meaning) text,
inline constexpr const char* kPairedNames[] = {LANELIGHT_PAIRED(X)};
inline constexpr const char* kBlockLayoutNames[] = {LANELIGHT_BLOCK_LAYOUTS(X)};
#undef X
inline constexpr const char* kHeuristicNames[] = {"power", "balance"};

}  // namespace lanelight
