#include "src/prepare/tables.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const CompiledScene& scene) {
  const Strategy& strategy = scene.strategy;
  StrategyTables tables;
  if (strategy.control == Control::kAmbient) tables.ambient = MakeAmbientLights(scene);
  return tables;
}

}  // namespace lanelight
