// From a description to a scene that can be rendered.
#pragma once

#include "src/compile/compile.h"

namespace lanelight {

/// CompileScene, and the tables of the description's strategy (UseStrategy). Throws
/// InputError as CompileScene does.
CompiledScene PrepareScene(const SceneDescription& description,
                           const CompileOptions& options = {});

}  // namespace lanelight
