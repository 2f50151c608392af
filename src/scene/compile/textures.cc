#include "src/scene/compile/textures.h"

#include <algorithm>

#include "src/base/core/check.h"

namespace lanelight {

namespace {

void MarkOperands(const std::vector<Texture>& textures, std::size_t i,
                  std::vector<bool>& used) {
  const Texture& t = textures[i];
  for (Index operand : {t.tex1.texture, t.tex2.texture, t.amount.texture}) {
    if (operand == kNone) continue;
    LL_CHECK_GE(operand, 0);
    LL_CHECK_LT(static_cast<std::size_t>(operand), i);
    used[static_cast<std::size_t>(operand)] = true;
  }
}

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
  if (std::ranges::none_of(textures, is_used)) textures = {};
}

bool IsPattern(TextureKind kind) {
  return kind == TextureKind::kFbm || kind == TextureKind::kWrinkled ||
         kind == TextureKind::kWindy || kind == TextureKind::kMarble;
}

bool HasMapping(const Texture& t) {
  return t.kind == TextureKind::kImage || t.kind == TextureKind::kDots ||
         t.kind == TextureKind::kBilinear ||
         (t.kind == TextureKind::kCheckerboard && t.dimension == 2);
}

bool IsSolid(const Texture& t) {
  return t.kind == TextureKind::kCheckerboard && t.dimension == 3;
}

// Row i of the node's map = the combination of the transform's rows by `weights`.
void SetRow(const Transform& m, Vec3d weights, double delta, float row[4]) {
  for (int c = 0; c < 4; ++c) {
    const double sum = weights.x * m(0, c) + weights.y * m(1, c) + weights.z * m(2, c);
    row[c] = static_cast<float>(sum + (c == 3 ? delta : 0));
  }
}

}  // namespace

TextureConstants::TextureConstants(const std::vector<Texture>& textures) {
  constants_.reserve(textures.size());
  for (const Texture& texture : textures) constants_.push_back(ConstantOf(texture));
}

std::optional<Rgb> TextureConstants::ConstantOf(const Texture& t) const {
  switch (t.kind) {
    case TextureKind::kConstant:
      return t.value;
    case TextureKind::kScale: {
      const auto a = ValueOf(t.tex1);
      const auto s = ValueOf(t.amount);
      if (a && s) return *a * *s;
      break;
    }
    case TextureKind::kMix: {
      const auto a = ValueOf(t.tex1), b = ValueOf(t.tex2);
      const auto w = ValueOf(t.amount);
      if (a && b && w) return *a * (1 - *w) + *b * *w;
      break;
    }
    default:
      break;
  }
  return std::nullopt;  // depends on the point
}

std::optional<Rgb> TextureConstants::ValueOf(const ColorValue& v) const {
  return v.texture == kNone ? v.constant : Of(v.texture);
}

std::optional<double> TextureConstants::ValueOf(const FloatValue& v) const {
  if (v.texture == kNone) return v.constant;
  const std::optional<Rgb>& c = Of(v.texture);
  return c ? std::optional<double>(c->x) : std::nullopt;
}

ColorValue TextureConstants::Fold(const ColorValue& value) const {
  if (value.texture == kNone) return value;  // with its spectrum
  const std::optional<Rgb> c = ValueOf(value);
  return c ? ColorValue{*c, kNone} : value;
}

FloatValue TextureConstants::Fold(const FloatValue& value) const {
  const std::optional<double> c = ValueOf(value);
  return c ? FloatValue{*c, kNone} : value;
}

std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used) {
  std::vector<bool> keep(textures.size(), false);
  for (Index i : used) {
    LL_CHECK_GE(i, 0);
    keep.at(static_cast<std::size_t>(i)) = true;
  }
  // Operands are earlier, so what needs a texture has been seen before it.
  std::vector<Texture> kept = textures;
  for (std::size_t i = kept.size(); i-- > 0;) {
    if (keep[i]) {
      MarkOperands(textures, i, keep);
      continue;
    }
    Texture unused;
    unused.name = kept[i].name;
    unused.where = kept[i].where;
    unused.is_float = kept[i].is_float;
    kept[i] = unused;
  }
  return kept;
}

BumpMaps BumpMapCompiler::Of(const Material& material,
                             const TextureConstants& constants) {
  if (material.normal_map.empty()) {
    return {constants.Fold(material.displacement).texture, kNone};
  }
  const Index next = static_cast<Index>(first_ + derived_.size());
  const auto [it, is_new] = index_.try_emplace(material.normal_map, next);
  if (is_new) derived_.push_back(NormalMap(material));
  return {kNone, it->second};
}

void DropUnusedBumpMaps(MaterialTable& table) {
  DropUnused(table.displacement_texture);
  DropUnused(table.normal_map_texture);
}

bool UsesPlace(const Texture& t) {
  return IsPattern(t.kind) || IsSolid(t) || t.kind == TextureKind::kDirectionMix ||
         (HasMapping(t) && t.mapping.kind != MappingKind::kUv);
}

void SetPlace(const Texture& t, const Transform& world_from_scene, TextureNode& node) {
  if (!UsesPlace(t)) return;
  if (t.kind == TextureKind::kDirectionMix) {
    for (int c = 0; c < 3; ++c) node.place[0][c] = static_cast<float>(t.direction[c]);
    return;
  }
  node.solid = IsSolid(t);
  node.octaves = t.octaves;
  node.roughness = static_cast<float>(t.roughness);
  node.variation = static_cast<float>(t.variation);
  const Transform map = t.texture_from_world * world_from_scene;
  if (HasMapping(t)) node.mapping = t.mapping.kind;
  if (node.mapping == MappingKind::kPlanar) {
    SetRow(map, t.mapping.v1, t.mapping.du, node.place[0]);
    SetRow(map, t.mapping.v2, t.mapping.dv, node.place[1]);
    return;
  }
  const double scale = t.kind == TextureKind::kMarble ? t.noise_scale : 1;
  SetRow(map, {scale, 0, 0}, 0, node.place[0]);
  SetRow(map, {0, scale, 0}, 0, node.place[1]);
  SetRow(map, {0, 0, scale}, 0, node.place[2]);
}

}  // namespace lanelight
