// Determines the features that a compiled scene needs; each costs time or memory.
#pragma once

#include "src/scene/compile/placement.h"
#include "src/scene/compiled/scene.h"
#include "src/vocabulary/path/features.h"

namespace lanelight {

/// Returns the features of the material table (whose textures are all uv-dependent:
/// constants are folded) and the alpha of the shapes: kinds, textures, kUv, kTangents,
/// kAlpha, ...
FeatureSet MaterialFeatures(const MaterialTable& materials, const Placement& placement);

/// All other bits; `scene.features` already holds those of the materials.
FeatureSet SceneFeatures(const CompiledScene& scene);

}  // namespace lanelight
