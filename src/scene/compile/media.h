// Participating media: coefficients per unit of scene length, and what lies beside each
// primitive.
#pragma once

#include "src/scene/compile/geometry.h"
#include "src/scene/compile/materials.h"

namespace lanelight {

/// The media that the camera stands in or that a placed shape bounds, with a phase
/// function for each appended to `materials`; nothing if there are none. Lists the sides
/// of each shape that bounds a medium, but not yet by primitive. Notes dense media.
MediumTable CompileMedia(const SceneDescription& description, const Placement& placement,
                         CompiledMaterials& materials, std::vector<Note>& notes);

/// Fills in MediumTable::primitives, where a shape bounds a medium.
void PlaceMedia(const Placement& placement, const CompiledGeometry& compiled,
                MediumTable& table);

}  // namespace lanelight
