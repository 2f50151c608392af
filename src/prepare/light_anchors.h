// The places around which distances=equiangular looks for points in media.
#pragma once

#include "src/compiled/scene.h"

namespace lanelight {

/// Points in some medium can be found by the angle around a light: the medium is the same
/// everywhere and scatters, and a light is sampled that has a place.
bool HasAnchors(const Strategy& strategy, const CompiledScene& scene);

/// Sets scene.media.anchors and their table, or empties them where they have no use.
void SetLightAnchors(const Strategy& strategy, CompiledScene& scene);

}  // namespace lanelight
