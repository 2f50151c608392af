#include "src/strategy/tables.h"

namespace lanelight {

StrategyTables MakeStrategyTables(const CompiledScene&) { return {}; }

}  // namespace lanelight
