// Properties of textures that compiling needs before they are compiled.
#pragma once

#include <optional>
#include <vector>

#include "src/scene/description/description.h"

namespace lanelight {

/// Which textures are the same everywhere: constants, and scale and mix of constants.
/// Checkerboards, images and what is built on them depend on uv. Textures refer to
/// earlier ones only, so one pass finds them all, however they are nested.
class TextureConstants {
 public:
  explicit TextureConstants(const std::vector<Texture>& textures);

  /// The value of a texture that is the same everywhere.
  const std::optional<Rgb>& Of(Index texture) const {
    return constants_.at(static_cast<std::size_t>(texture));
  }
  /// The same value, with a constant texture replaced by its constant.
  ColorValue Fold(const ColorValue& value) const;
  FloatValue Fold(const FloatValue& value) const;

 private:
  std::optional<Rgb> ConstantOf(const Texture& texture) const;
  std::optional<Rgb> ValueOf(const ColorValue& v) const;
  std::optional<double> ValueOf(const FloatValue& v) const;

  std::vector<std::optional<Rgb>> constants_;
};

/// A copy in which every texture that none of `used` needs is a black constant, so that
/// its file is not read. Indices stay what they are.
std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used);

}  // namespace lanelight
