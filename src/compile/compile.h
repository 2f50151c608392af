// SceneDescription (double precision, file units) to CompiledScene (what kernels read).
#pragma once

#include <optional>

#include "src/compiled/scene.h"
#include "src/scene/description.h"

namespace lanelight {

struct CompileOptions {
  std::optional<Scattering> scattering;  // overrides every diffuse material
  BuildQuality build = BuildQuality::kHigh;
};

/// Throws InputError if the scene cannot be rendered (a missing image, a shape that the
/// renderer cannot represent), with the place in the file that asked for it.
/// Loads the image files that textures and environments name.
CompiledScene CompileScene(const SceneDescription& description,
                           const CompileOptions& options = {});

}  // namespace lanelight
