// Prepares a compiled scene for a strategy: probabilities of the lights. Cheap next to
// compiling, so that one scene can be rendered with many strategies.
#pragma once

#include "src/compiled/scene.h"

namespace lanelight {

/// Sets scene.strategy, and the probabilities, table or tree by which lights are
/// selected.
void UseStrategy(const Strategy& strategy, CompiledScene& scene);

}  // namespace lanelight
