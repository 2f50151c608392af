// Where light subpaths from infinity start (EmissionGuide, src/scene/prepare/tables.h).
#pragma once

#include <vector>

#include "src/scene/prepare/tables.h"

namespace lanelight {

/// Weights >= 0 of cells, at least one of each square positive, and of lights.
struct EmissionWeights {
  std::vector<double> cells, lights;
};

/// Returns the cells of the scene's lights, which have not learned yet: of the first 64
/// distant lights, and of the sky.
EmissionGuide MakeEmissionGuide(const LightTable& table);

/// Returns weights before anything is known: all cells alike; half by power, half alike
/// for each distant light, the sky and all other lights together.
EmissionWeights PlainEmissionWeights(const LightTable& table, const EmissionGuide& guide,
                                     const LightEmission& emission);

/// Returns the weights that follow from what subpaths have brought: `light[i]` from cell
/// i, and behind the cells from each light that has none. A tenth of a light's weight
/// remains as it was, so that what has not been found yet is still looked for.
EmissionWeights LearnedEmissionWeights(const LightTable& table,
                                       const EmissionGuide& guide,
                                       const LightEmission& emission,
                                       const std::vector<double>& light);

/// Returns whether tables can be made of weights of the right number: finite, not
/// negative, and some above 0 in each square and among the lights.
bool AreUsable(const EmissionWeights& weights, const EmissionGuide& guide);

/// Makes the guide's tables of such weights.
void Learn(EmissionWeights weights, EmissionGuide& guide);

}  // namespace lanelight
