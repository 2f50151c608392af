// Groups samples of a pixel: those of a group depend on each other and count as one
// observation (src/vocabulary/path/replicates.h).
#pragma once

#include <cstdint>
#include <string>

#include "src/vocabulary/path/replicates.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

/// log2 of the points of one randomisation; what follows is randomised anew.
std::uint32_t LogSequence(Points points);

/// Returns the groups that count as one observation.
SampleGroups GroupsOf(const Strategy& strategy);

/// "sobol, 4 randomisations of 16 points", ... for reports; spp = 0: unknown.
std::string PointsText(const Strategy& strategy, std::uint64_t spp);

}  // namespace lanelight
