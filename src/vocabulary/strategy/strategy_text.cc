#include "src/vocabulary/strategy/strategy_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/base/core/source_location.h"

namespace lanelight {

Strategy StrategyNamed(const std::string& name, const SourceLocation& where,
                       const Strategy& own) {
  if (name == kSceneStrategyName) return own;
  Strategy strategy;
  ApplyStrategy(name, where, strategy);
  return strategy;
}

std::string ChoicesNotIn(std::string_view other, std::string_view text) {
  const std::string all = fmt::format(",{},", other);
  std::string found;
  while (!text.empty()) {
    const std::string_view choice = text.substr(0, text.find(','));
    text.remove_prefix(std::min(choice.size() + 1, text.size()));
    if (all.find(fmt::format(",{},", choice)) != all.npos) continue;
    found += (found.empty() ? "" : ",") + std::string(choice);
  }
  return found;
}

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
