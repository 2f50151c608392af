// The features that choices of a strategy turn on.
#pragma once

#include "src/vocabulary/path/features.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

// Of one choice each, from the lists in src/vocabulary/strategy/choices.h.
FeatureSet TurnsOn(Directions choice);
FeatureSet TurnsOn(Points choice);
FeatureSet TurnsOn(Pairs choice);
FeatureSet TurnsOn(Control choice);
FeatureSet TurnsOn(Roulette choice);
FeatureSet TurnsOn(LightSelection choice);
FeatureSet TurnsOn(LightPoints choice);
FeatureSet TurnsOn(LightCandidates choice);
FeatureSet TurnsOn(ShadowRoulette choice);
FeatureSet TurnsOn(Distances choice);
FeatureSet TurnsOn(Reuse choice);
FeatureSet TurnsOn(Decide choice);

}  // namespace lanelight
