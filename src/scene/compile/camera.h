// The camera in scene coordinates.
#pragma once

#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Throws InputError for a camera that maps space onto a plane, a field of view outside
/// (0, 180), an empty screen window.
CompiledCamera CompileCamera(const Camera& camera, const Film& film,
                             const WorldFrame& frame);

}  // namespace lanelight
