// Prepares a compiled scene for a strategy: probabilities of the lights, and of the
// texels of environment images, and the places that points in media are looked for
// around. Cheap next to compiling, so that one scene can be rendered with many
// strategies.
#pragma once

#include "src/compiled/scene.h"

namespace lanelight {

/// environment=compensated has an effect: what light samples leave out, scattered rays
/// must find with their full weight, as with directions=mis.
bool CompensatesEnvironment(const Strategy& strategy);

/// Sets scene.strategy, the probabilities, table or tree by which lights are selected,
/// and the tables of environment images. `scene` comes from CompileScene or from a call
/// of this, and its strategy is as those have left it.
void UseStrategy(const Strategy& strategy, CompiledScene& scene);

}  // namespace lanelight
