// Displacement textures and normal maps of materials, on their way into MaterialTable.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "src/scene/compile/textures.h"
#include "src/scene/compiled/materials.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// The effect of a material on the shading normal: at most one of the two textures.
struct Relief {
  Index displacement = kNone, normal_map = kNone;
};

/// Finds the relief of materials. Normal maps are files: each becomes a texture of its
/// own in `derived`, which are numbered after those of the description.
class Reliefs {
 public:
  Reliefs(const std::vector<Texture>& textures, std::vector<Texture>& derived)
      : first_(textures.size()), derived_(derived) {}

  /// A constant height has no slope and is left out. A normal map goes before a height,
  /// as in pbrt-v4.
  Relief Of(const Material& material, const TextureConstants& constants);

 private:
  std::size_t first_;
  std::map<std::string, Index> index_;
  std::vector<Texture>& derived_;
};

/// Columns that no material uses become empty.
void DropUnusedReliefs(MaterialTable& table);

}  // namespace lanelight
