// Finds the media in which light subpaths start (light-paths=splats).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

/// Returns LightEmission::media. Sets the `weights` of lights to 0 at which no subpath
/// may start, as it would not find what camera paths find: lights at infinity outside of
/// a medium without end; lights whose points are in several media or, by MediumMap, in
/// unclear ones; all lights, if the media beside surfaces contradict the camera's.
AlignedVector<std::int32_t> FindLightMedia(const CompiledScene& scene,
                                           std::vector<double>& weights);

}  // namespace lanelight
