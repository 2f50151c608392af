#include "src/scene/prepare/tables.h"

#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const PreparedScene& scene) {
  StrategyTables tables;
  tables.shadow_worth.floor = static_cast<float>(scene.strategy.ShadowFloor());
  return tables;
}

}  // namespace lanelight
