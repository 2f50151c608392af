#include "src/measure/study/options.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

// Presets from Figure 2 on; what they share is paper-plain.
constexpr const char* kFigures[] = {"paper-uniform",    "paper-importance",
                                    "paper-stratified", "paper-antithetic",
                                    "paper-control",    "paper-roulette"};

std::vector<std::string> PaperStrategies() {
  std::vector<std::string> names = {"paper-plain"};
  names.insert(names.end(), std::begin(kFigures), std::end(kFigures));
  names.insert(names.end(), {kDefaultStrategyName, kSceneStrategyName});
  return names;
}

// The default, every choice alone changed from it, and the paper's presets.
std::vector<std::string> AllStrategies() {
  std::vector<std::string> names = {kDefaultStrategyName};
  for (const ChoiceInfo& c : AllChoices()) {
    names.push_back(std::string(c.axis) + "=" + c.name);
  }
  for (const PresetInfo& p : AllPresets()) names.push_back(p.name);
  names.push_back(kSceneStrategyName);
  return names;
}

}  // namespace

int StudyOptions::Repetitions() const {
  if (repetitions) return *repetitions;
  return 2 + static_cast<int>(std::ceil(std::log2(2 / (1 - confidence))));
}

std::vector<NamedStrategy> StudyStrategies(const StudyOptions& options,
                                           const Strategy& own) {
  const std::vector<std::string> names = options.all_strategies ? AllStrategies()
                                         : options.strategies.empty()
                                             ? PaperStrategies()
                                             : options.strategies;
  std::vector<NamedStrategy> strategies;
  for (const std::string& name : names) {
    const auto same = [&](const NamedStrategy& other) { return other.name == name; };
    if (std::any_of(strategies.begin(), strategies.end(), same)) continue;
    strategies.push_back(
        {name,
         StrategyNamed(name, {std::make_shared<const std::string>("--strategies"), 0, 0},
                       own)});
  }
  return strategies;
}

int PaperFigure(const std::string& name) {
  const auto found = std::find(std::begin(kFigures), std::end(kFigures), name);
  return found == std::end(kFigures) ? 0 : 2 + static_cast<int>(found - kFigures);
}

}  // namespace lanelight
