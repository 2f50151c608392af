// Decides whether a strategy makes sense on a scene.
#pragma once

#include <string>
#include <vector>

#include "src/render/plan/plan.h"

namespace lanelight {

/// Throws InputError for a strategy that cannot work on this scene, saying what would.
/// Returns explanations of choices that have no effect on it.
std::vector<std::string> CheckStrategy(const PreparedScene& scene,
                                       const PlanOptions& options);

}  // namespace lanelight
