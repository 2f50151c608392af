// What compiling needs to know about textures before they are compiled.
#pragma once

#include <optional>
#include <vector>

#include "src/scene/description.h"

namespace lanelight {

/// Value of a texture that is the same everywhere (constants, and scale and mix of
/// constants); nullopt for checkerboards, images and what is built on them, all of which
/// depend on uv.
std::optional<Rgb> ConstantTexture(const std::vector<Texture>& textures, Index texture);

/// The same value, with a constant texture replaced by its constant.
ColorValue FoldConstant(const std::vector<Texture>& textures, const ColorValue& value);
FloatValue FoldConstant(const std::vector<Texture>& textures, const FloatValue& value);

/// A copy in which every texture that none of `used` needs is a black constant, so that
/// its file is not read. Indices stay what they are.
std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used);

}  // namespace lanelight
