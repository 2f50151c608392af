// Motions in compiled coordinates.
#pragma once

#include "src/base/core/motion.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {

/// From an object's frame to that of the scene, of a motion from its coordinates to the
/// world's.
Motion InFrames(const Motion& motion, const WorldFrame& scene, const WorldFrame& object);

/// What takes the scene as a camera sees it at the start to the scene as it sees it
/// later, in the scene's frame; `motion` is that of the camera, to the world.
Motion OfCamera(const Motion& motion, const WorldFrame& scene);

}  // namespace lanelight
