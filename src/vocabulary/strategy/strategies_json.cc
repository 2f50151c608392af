#include "src/vocabulary/strategy/strategies_json.h"

#include <nlohmann/json.hpp>

#include "src/base/core/source_location.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

nlohmann::json StrategiesJson() {
  nlohmann::json choices = nlohmann::json::array(), presets = nlohmann::json::array();
  for (const ChoiceInfo& c : AllChoices()) {
    choices.push_back({{"axis", c.axis},
                       {"name", c.name},
                       {"arguments", c.arguments},
                       {"meaning", c.meaning},
                       {"formula", c.formula},
                       {"source", c.source}});
  }
  for (const PresetInfo& p : AllPresets()) {
    Strategy strategy;
    ApplyStrategy(p.name, {}, strategy);
    presets.push_back(
        {{"name", p.name}, {"meaning", p.meaning}, {"strategy", ToText(strategy)}});
  }
  return {{"choices", choices}, {"presets", presets}, {"default", ToText(Strategy{})}};
}

}  // namespace lanelight
