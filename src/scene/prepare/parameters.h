// The parts of RunParameters that a strategy decides.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

PointsParameters MakePointsParameters(Points points);
PairParameters MakePairParameters(const Strategy& strategy);
MisParameters MakeMisParameters(const Strategy& strategy);
RouletteParameters MakeRouletteParameters(const Strategy& strategy);
/// Light samples of which a plan with these features keeps one.
std::uint32_t CandidatesOf(const Strategy& strategy, const FeatureSet& features);

}  // namespace lanelight
