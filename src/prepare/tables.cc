#include "src/prepare/tables.h"

#include "src/prepare/guide_cell.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const PreparedScene& scene) {
  const Strategy& strategy = scene.strategy;
  StrategyTables tables;
  if (strategy.guiding != Guiding::kNone) tables.guide = UnknowingGuide();
  tables.shadow_worth.floor = static_cast<float>(strategy.ShadowFloor());
  return tables;
}

}  // namespace lanelight
