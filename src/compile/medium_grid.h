// Media that vary: samples and the majorants that null collisions need.
#pragma once

#include "src/compile/frame.h"
#include "src/compiled/media.h"
#include "src/scene/description.h"

namespace lanelight {

/// The grid of a medium that has one, in scene units.
MediumGrid CompileMediumGrid(const Medium& medium, const Frame& frame);

}  // namespace lanelight
