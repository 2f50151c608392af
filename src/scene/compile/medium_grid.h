// Media that vary: samples and the majorants that null collisions need.
#pragma once

#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/media.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// The grid of a medium that has one, in scene units, for paths of this kind.
MediumGrid CompileMediumGrid(const Medium& medium, const WorldFrame& frame,
                             Transport transport = Transport::kRgb);

}  // namespace lanelight
