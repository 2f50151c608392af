// Lights at which light subpaths start (light-paths=splats).
#pragma once

#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Returns the table of lights that start light subpaths; an empty one if there are none.
/// `shapes_alone`: only emitting shapes, whose light camera paths find as well.
/// Excluded: infinite lights and lights at infinity in scenes with infinite planes, which
/// no disk of origins covers; infinite lights of scenes with a portal.
LightEmission MakeLightEmission(const CompiledScene& scene, bool shapes_alone);

}  // namespace lanelight
