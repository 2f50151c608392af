#include "src/prepare/use_strategy.h"

#include "src/compile/environment_table.h"
#include "src/core/alias_table.h"
#include "src/prepare/light_anchors.h"
#include "src/prepare/light_tree.h"

namespace lanelight {
namespace {

bool IsHittable(const CompiledScene& scene, const LightRecord& light) {
  return !IsUnseen(scene, light) &&
         !HasTrait(static_cast<LightShape>(light.shape), kDeltaLight);
}

// Relative probabilities; zero for lights that the strategy leaves to scattered rays.
std::vector<double> SelectionWeights(const Strategy& strategy,
                                     const CompiledScene& scene) {
  const LightTable& table = scene.lights;
  std::vector<double> weights(table.lights.size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (IsHittable(scene, table.lights[i]) && !strategy.SamplesHittableLights()) continue;
    weights[i] =
        strategy.light_selection == LightSelection::kUniform ? 1.0 : table.power[i];
  }
  return weights;
}

void UseTable(const std::vector<double>& weights, LightTable& table) {
  AliasTable alias = BuildAliasTable(weights);
  for (std::size_t i = 0; i < alias.size(); ++i) {
    table.lights[i].pmf = alias.probability[i];
  }
  table.alias_q = std::move(alias.q);
  table.alias = std::move(alias.alias);
}

void UseTree(const std::vector<double>& weights, CompiledScene& scene) {
  LightTable& table = scene.lights;
  table.tree = BuildLightTree(scene.geometry, table.lights, weights);
  for (LightRecord& light : table.lights) light.pmf = 0;
  for (std::uint32_t light : table.tree.far) {
    table.lights[light].pmf = table.tree.pmf_far;
  }
}

// The tables are plain unless the strategy that they were prepared for compensated them;
// then, and where the new one does, they are made anew.
void UseEnvironmentTables(const Strategy& strategy, CompiledScene& scene) {
  const bool compensated = CompensatesEnvironment(strategy);
  if (!compensated && !CompensatesEnvironment(scene.strategy)) return;
  for (Environment& environment : scene.lights.environments) {
    SetEnvironmentTable(compensated, environment);
  }
}

}  // namespace

bool CompensatesEnvironment(const Strategy& strategy) {
  return strategy.environment == EnvironmentPoints::kCompensated &&
         strategy.directions == Directions::kMis;
}

void UseStrategy(const Strategy& strategy, CompiledScene& scene) {
  UseEnvironmentTables(strategy, scene);
  scene.strategy = strategy;
  SetLightAnchors(strategy, scene);
  LightTable& table = scene.lights;
  table.tree = {};
  table.alias_q.clear();
  table.alias.clear();
  for (LightRecord& light : table.lights) light.pmf = 0;
  const std::vector<double> weights = SelectionWeights(strategy, scene);
  bool any = false;
  for (double w : weights) any |= w > 0;
  if (!any) return;
  if (strategy.light_selection == LightSelection::kTree && weights.size() > 1) {
    UseTree(weights, scene);
  } else {
    UseTable(weights, table);
  }
}

}  // namespace lanelight
