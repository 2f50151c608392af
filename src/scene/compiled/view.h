// How a scene is seen.
#pragma once

#include "src/scene/compiled/camera.h"
#include "src/scene/compiled/footprint.h"
#include "src/scene/compiled/gbuffer.h"
#include "src/scene/description/film.h"

namespace lanelight {

/// What depends on the camera and on the size of the film. Kernels read all but the film.
struct CompiledView {
  Film film;
  CompiledCamera camera;
  PixelFootprint footprint;
  GbufferSpace gbuffer;
};

}  // namespace lanelight
