#include "src/vocabulary/strategy/named_strategy.h"

#include "src/base/core/source_location.h"

namespace lanelight {

Strategy StrategyNamed(const std::string& name, const SourceLocation& where,
                       const Strategy& own) {
  if (name == kSceneStrategyName) return own;
  Strategy strategy;
  if (name != kDefaultStrategyName) ApplyStrategy(name, where, strategy);
  return strategy;
}

}  // namespace lanelight
