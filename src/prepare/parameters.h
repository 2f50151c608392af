// The parts of RunParameters that a strategy decides.
#pragma once

#include <cstdint>

#include "src/path/run_parameters.h"
#include "src/strategy/strategy.h"

namespace lanelight {

/// group_size: a power of two for sobol and pmj02, at most MostGroupSize(points).
PointsParameters MakePointsParameters(Points points, std::uint32_t group_size);
PairParameters MakePairParameters(const Strategy& strategy);
MisParameters MakeMisParameters(const Strategy& strategy);
RouletteParameters MakeRouletteParameters(const Strategy& strategy);

}  // namespace lanelight
