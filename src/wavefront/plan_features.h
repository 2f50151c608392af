// What a render needs: the features of the scene, as changed by its strategy and by the
// options; and whether the strategy makes sense on this scene.
#pragma once

#include <string>
#include <vector>

#include "src/wavefront/plan.h"

namespace lanelight {

FeatureSet PlanFeatures(const CompiledScene& scene, const PlanOptions& options);

/// The scene's strategy as the options change it.
Strategy PlannedStrategy(const CompiledScene& scene, const PlanOptions& options);

/// Throws InputError for a strategy that cannot work on this scene, saying what would.
/// Returns explanations of choices that have no effect on it.
std::vector<std::string> CheckStrategy(const CompiledScene& scene,
                                       const PlanOptions& options);

}  // namespace lanelight
