// The space that --gbuffer names, from the scene's.
#pragma once

#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/gbuffer.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Nothing without a g-buffer. The camera's space is pbrt's: x to the right, y up, z
/// forward, in the units of its transform.
GbufferSpace CompileGbufferSpace(const Film& film, const Camera& camera,
                                 const WorldFrame& frame);

}  // namespace lanelight
