// Scenes of emitting shapes that alpha cuts.
#pragma once

#include "src/scene/description/description.h"

namespace lanelight::test {

/// Holes where a checkerboard of that many cells per unit of u and v is odd.
Texture Holes(double cells);

/// Shapes of every kind, one- and two-sided, cut by their coordinates, by place and
/// evenly, one with an image as well.
SceneDescription CutLamps();
/// Through whose holes one sees inside: bright within and without, within alone, without.
SceneDescription CutBalls();
/// Of alpha 0, beside one that is seen.
SceneDescription UnseenLamps();
/// Some of each.
SceneDescription MixedLamps();

}  // namespace lanelight::test
