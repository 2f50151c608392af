// A scene that moves, at one time: what the reference tracer renders of it.
#pragma once

#include "src/scene/description/description.h"

namespace lanelight::reference {

/// Between two transforms as pbrt-v4 describes it, by quaternions.
Transform Interpolate(const Transform& start, const Transform& end, double time);

/// Everything where it is at a time from 0 to 1, and nothing that moves.
SceneDescription Snapshot(const SceneDescription& scene, double time);

}  // namespace lanelight::reference
