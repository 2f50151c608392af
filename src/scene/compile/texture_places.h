// Textures that depend on where a point is, rather than on its surface coordinates.
#pragma once

#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Returns whether this texture itself, operands aside, depends on the place or the
/// normal.
bool UsesPlace(const Texture& texture);

/// Sets what the kernels need of mappings and patterns; nothing where !UsesPlace.
void SetPlace(const Texture& texture, const Transform& world_from_scene,
              TextureNode& node);

}  // namespace lanelight
