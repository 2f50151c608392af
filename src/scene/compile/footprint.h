// The footprint of a pixel for filtered textures (src/scene/compiled/footprint.h).
#pragma once

#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/footprint.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// `samples`: `pixelsamples` of the scene's Sampler, at least 1.
PixelFootprint CompileFootprint(const CompiledCamera& compiled, const Camera& camera,
                                const Film& film, int samples);

}  // namespace lanelight
