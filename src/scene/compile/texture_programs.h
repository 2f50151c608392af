// Textures of a description to the programs that kernels run.
#pragma once

#include <vector>

#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Compiles the textures of a description; index i stays index i. Loads each image file
/// once, in parallel. Semantics are those of pbrt-v4 (scale before invert, negative
/// results cut at 0, a float texture reads alpha if there is any below 1, else the mean
/// of colour), without its mip levels: level 0 is sampled. `world_from_scene`: of the
/// places at which kernels look textures up. Throws InputError naming the texture's place
/// and the file. Files with values that are not finite leave a note.
TextureTable CompileTextures(const std::vector<Texture>& textures,
                             const Transform& world_from_scene = {},
                             std::vector<Note>* notes = nullptr);

/// Decoded value of byte `b` (0..255) for an encoding.
double DecodeByte(int b, Encoding encoding, double gamma);

}  // namespace lanelight
