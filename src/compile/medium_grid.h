// Media that vary: samples and the majorants that null collisions need.
#pragma once

#include "src/compile/frame.h"
#include "src/compiled/media.h"
#include "src/scene/description.h"

namespace lanelight {

/// The grid of a medium that has one, in scene units, for paths of this kind.
MediumGrid CompileMediumGrid(const Medium& medium, const Frame& frame,
                             Transport transport = Transport::kRgb);

}  // namespace lanelight
