// Textures of a description to the programs that kernels run.
#pragma once

#include <vector>

#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Compiles the textures of a description; indices stay. Loads each image file once, in
/// parallel. Semantics are those of pbrt-v4 (scale before invert, negative results cut at
/// 0, a float texture reads alpha if any is below 1, else the mean of the colour), but
/// only level 0 is sampled. `world_from_scene` maps the positions at which kernels look
/// textures up. Throws InputError with the texture's location and the file. Files with
/// non-finite values leave a note.
TextureTable CompileTextures(const std::vector<Texture>& textures,
                             const Transform& world_from_scene = {},
                             std::vector<Note>* notes = nullptr);

/// Decoded value of byte `b` (0..255) for an encoding.
double DecodeByte(int b, Encoding encoding, double gamma);

}  // namespace lanelight
