// Finds lights at which light subpaths start (light-paths=splats).
#pragma once

#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Returns the table of lights that start light subpaths; an empty one if there are none.
/// Excluded: shapes that no ray meets; portals, and infinite lights beside one; distant
/// and infinite lights in scenes with alpha on an infinite plane; lights that
/// FindLightMedia excludes.
LightEmission MakeLightEmission(const CompiledScene& scene);

}  // namespace lanelight
