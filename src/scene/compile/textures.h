// Properties of textures: constants, use, bump and normal maps, positions.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/compiled/materials.h"
#include "src/scene/compiled/texture_table.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Finds the constant textures: constants, and scale and mix of constants. Textures refer
/// to earlier ones only, so one pass finds them all.
class TextureConstants {
 public:
  explicit TextureConstants(const std::vector<Texture>& textures);

  /// Returns the value of a constant texture.
  const std::optional<Rgb>& Of(Index texture) const {
    return constants_.at(static_cast<std::size_t>(texture));
  }
  /// Replaces a constant texture by its constant.
  ColorValue Fold(const ColorValue& value) const;
  FloatValue Fold(const FloatValue& value) const;

 private:
  std::optional<Rgb> ConstantOf(const Texture& texture) const;
  std::optional<Rgb> ValueOf(const ColorValue& v) const;
  std::optional<double> ValueOf(const FloatValue& v) const;

  std::vector<std::optional<Rgb>> constants_;
};

/// Returns a copy in which textures that no texture in `used` needs are black constants,
/// so that their files are not read. Indices stay the same.
std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used);

/// The effect of a material on the shading normal: at most one of the two textures.
struct BumpMaps {
  Index displacement = kNone, normal_map = kNone;
};

/// Finds the bump and normal maps of materials. Normal maps are files: each becomes a
/// texture of its own in `derived`, which are numbered after those of the description.
class BumpMapCompiler {
 public:
  BumpMapCompiler(const std::vector<Texture>& textures, std::vector<Texture>& derived)
      : first_(textures.size()), derived_(derived) {}

  /// A constant height has no slope and is left out. A normal map goes before a height,
  /// as in pbrt-v4.
  BumpMaps Of(const Material& material, const TextureConstants& constants);

 private:
  std::size_t first_;
  std::map<std::string, Index> index_;
  std::vector<Texture>& derived_;
};

/// Empties the columns that no material uses.
void DropUnusedBumpMaps(MaterialTable& table);

/// Returns whether the texture itself, without operands, depends on position or normal.
bool UsesPlace(const Texture& texture);

/// Sets the node's mapping and pattern if UsesPlace.
void SetPlace(const Texture& texture, const Transform& world_from_scene,
              TextureNode& node);

}  // namespace lanelight
