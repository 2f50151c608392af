// The view of a scene.
#pragma once

#include "src/scene/compiled/camera.h"
#include "src/scene/description/film.h"

namespace lanelight {

/// Data that depend on the camera and the film's size. Kernels read all but the film.
struct CompiledView {
  Film film;
  CompiledCamera camera;
  PixelFootprint footprint;
  GbufferSpace gbuffer;
};

}  // namespace lanelight
