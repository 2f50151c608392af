#include "src/scene/prepare/tables.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const PreparedScene& scene) {
  StrategyTables tables;
  tables.shadow_worth.floor = static_cast<float>(scene.strategy.ShadowFloor());
  return tables;
}

}  // namespace lanelight
