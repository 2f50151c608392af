// Tables that some strategies need, built once per render and read by kernels.
#pragma once

#include "src/core/aligned.h"
#include "src/scene/compiled.h"
#include "src/strategy/ambient.h"

namespace lanelight {

struct StrategyTables {
  std::vector<AmbientLight> ambient;  // control=ambient
};

/// What the strategy of the scene needs, and nothing else.
StrategyTables MakeStrategyTables(const CompiledScene& scene);

}  // namespace lanelight
