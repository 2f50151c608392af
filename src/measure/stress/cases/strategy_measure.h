// One scene, rendered with every choice of every axis of a strategy.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/measure/stress/cases/points.h"

namespace lanelight::stress {

/// A scene that is rendered, and how strategies are known to perform on it.
struct StrategyScene {
  std::string text;
  double expected = 0;
  Quality quality;
  /// Probability that a sample of this strategy finds the light that matters; 1: no
  /// rarity.
  std::function<double(const std::string& strategy)> chance = [](const std::string&) {
    return 1.0;
  };
  /// Why a strategy is left out here; empty: it is not.
  std::function<std::string(const std::string& strategy)> omission_reason =
      [](const std::string&) { return std::string(); };
};

/// Directions that know nothing of lights: tiny ones are found by chance.
bool FindsLightsByChance(const std::string& strategy);
/// Renders a pilot of its own first.
bool HasTraining(const std::string& strategy);

/// One point for each choice, all others as by default; series are called what --strategy
/// takes. Seconds are without pilots, which are the same for any length. Omits strategies
/// that the scene does not support or that too few samples cannot judge.
std::vector<Point> MeasureAll(const StrategyScene& scene, const Effort& effort);

}  // namespace lanelight::stress
