// Shapes that emit, as lights.
#pragma once

#include "src/scene/compile/geometry.h"
#include "src/scene/compile/light_list.h"
#include "src/scene/compile/light_texels.h"
#include "src/scene/compile/placement.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Adds a light for each emitting triangle, rectangle of two triangles, sphere and disk,
/// and sets the `light` of its records in `geometry`. Throws InputError at the light for
/// images that cannot be used.
void CompileAreaLights(const SceneDescription& description, const Placement& placement,
                       CompiledGeometry& geometry, LightImageTable& images,
                       LightList& lights);

}  // namespace lanelight
