#include "src/measure/stress/cases/strategy_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::stress {
namespace {

// One choice changed at a time, of the default strategy.
std::vector<std::string> Strategies() {
  std::vector<std::string> all = {"directions=mis:balance"};
  for (const ChoiceInfo& choice : AllChoices()) {
    if (choice.axis == std::string("decide")) continue;  // for one of the others
    all.push_back(fmt::format("{}={}", choice.axis, choice.name));
  }
  return all;
}

// So many samples that carry all of the light must be expected for their scatter to mean
// anything.
constexpr double kMinExpectedHits = 40;

Point Measure(const StrategyScene& scene, const std::string& strategy,
              const Effort& effort) {
  const std::string omission_reason = scene.omission_reason(strategy);
  if (!omission_reason.empty()) return NotMeasured(strategy, omission_reason);
  Quality quality = scene.quality;
  quality.strategy = strategy;
  SceneText setup = Setup(scene.text, quality, effort);
  const double samples = double(*setup.settings.spp) * quality.size * quality.size;
  const double chance = scene.chance(strategy), hits = samples * chance;
  if (hits < kMinExpectedHits) {
    return NotMeasured(
        strategy,
        fmt::format("only {:.2g} of {} samples find the light: too few for a test", hits,
                    samples));
  }
  try {
    const JobRun rendered = RenderText(setup);
    Point point = MeanOf(rendered);
    point.series = strategy;
    point.expected = scene.expected;
    point.tolerance = kFloatError * scene.expected;
    point.seconds -= rendered.result.training.cpu_seconds;  // the same for any length
    if (chance < 1) {
      // Found or not: what the scatter of so few is expected to be.
      const double rare = scene.expected * std::sqrt((1 - chance) / hits);
      point.standard_error = std::max(point.standard_error, rare);
    }
    return point;
  } catch (const InputError& refusal) {
    return NotMeasured(strategy, refusal.what());
  }
}

}  // namespace

bool FindsLightsByChance(const std::string& strategy) {
  return strategy == "directions=uniform" || strategy == "directions=bsdf";
}

bool HasTraining(const std::string& strategy) { return strategy == "roulette=adjoint"; }

std::vector<Point> MeasureAll(const StrategyScene& scene, const Effort& effort) {
  std::vector<Point> points;
  for (const std::string& strategy : Strategies()) {
    points.push_back(Measure(scene, strategy, effort));
  }
  return points;
}

}  // namespace lanelight::stress
