// Decides whether two strategies are one on a scene: what a render would do, as a text.
#pragma once

#include <string>

#include "src/render/plan/plan.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Everything of the scene's strategy that reaches the kernels and the film: features,
/// stages with their kernels, parameters that some stage reads, how samples are grouped,
/// the probabilities of the lights. The scene is prepared for the strategy
/// (WithStrategy), the plan made for it. Two strategies of one scene with equal keys give
/// the same samples, bit by bit, for the same work; with a probability of 2^-60 tables of
/// lights that differ have equal keys. Strategies that do the same in different ways (a
/// table of equal probabilities, and one found otherwise) may have different keys.
std::string PlanKey(const PreparedScene& scene, const Plan& plan);

}  // namespace lanelight
