#include "src/scene/compile/relief.h"

#include <algorithm>

namespace lanelight {
namespace {

Texture NormalMap(const Material& material) {
  Texture texture;
  texture.kind = TextureKind::kImage;
  texture.name = "normalmap of " + (material.name.empty() ? "a material" : material.name);
  texture.where = material.where;
  texture.path = material.normal_map;
  texture.encoding = Encoding::kLinear;
  return texture;
}

void DropUnused(AlignedVector<std::int32_t>& textures) {
  const auto is_used = [](std::int32_t t) { return t >= 0; };
  if (std::none_of(textures.begin(), textures.end(), is_used)) textures = {};
}

}  // namespace

Relief Reliefs::Of(const Material& material, const TextureConstants& constants) {
  if (material.normal_map.empty()) {
    return {constants.Fold(material.displacement).texture, kNone};
  }
  const Index next = static_cast<Index>(first_ + derived_.size());
  const auto [it, is_new] = index_.try_emplace(material.normal_map, next);
  if (is_new) derived_.push_back(NormalMap(material));
  return {kNone, it->second};
}

void DropUnusedReliefs(MaterialTable& table) {
  DropUnused(table.displacement_texture);
  DropUnused(table.normal_map_texture);
}

}  // namespace lanelight
