// The footprint of a pixel for filtered textures (src/compiled/footprint.h).
#pragma once

#include "src/compiled/camera.h"
#include "src/compiled/footprint.h"
#include "src/scene/description.h"

namespace lanelight {

/// `samples`: `pixelsamples` of the scene's Sampler, at least 1.
PixelFootprint CompileFootprint(const CompiledCamera& compiled, const Camera& camera,
                                const Film& film, int samples);

}  // namespace lanelight
