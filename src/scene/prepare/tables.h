// Tables that some strategies need, built once per render and read by kernels.
#pragma once

#include "src/scene/prepare/path_values.h"
#include "src/scene/prepare/shadow_worth.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

struct StrategyTables {
  PathValues path_values;    // adjoint, efficiency: set by the training passes
  ShadowWorth shadow_worth;  // shadow-roulette=contribution: by a training pass
};

/// What the strategy of the scene needs, and nothing else.
StrategyTables MakeStrategyTables(const PreparedScene& scene);

}  // namespace lanelight
