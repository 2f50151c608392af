#include "src/scene/compile/texture_places.h"

namespace lanelight {
namespace {

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
