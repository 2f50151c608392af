#include "src/prepare/light_anchors.h"

#include <algorithm>
#include <limits>

#include "src/core/alias_table.h"
#include "src/prepare/light_bounds.h"

namespace lanelight {
namespace {

bool ScattersEvenly(const MediumTable& table) {
  return std::any_of(table.media.begin(), table.media.end(),
                     [](const MediumRecord& m) { return m.grid < 0 && m.scatters != 0; });
}

LightAnchor AnchorOf(const Geometry& geometry, const LightRecord& light) {
  constexpr float kNowhere = std::numeric_limits<float>::infinity();
  if (!HasPlace(light)) return {{kNowhere, kNowhere, kNowhere}, 0};
  const Vec3d p = BoundsOf(geometry, light).Center();
  return {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, 0};
}

}  // namespace

bool HasAnchors(const Strategy& strategy, const CompiledScene& scene) {
  const auto& lights = scene.lights.lights;
  return strategy.distances == Distances::kEquiangular && ScattersEvenly(scene.media) &&
         std::any_of(lights.begin(), lights.end(), HasPlace);
}

void SetLightAnchors(const Strategy& strategy, CompiledScene& scene) {
  MediumTable& media = scene.media;
  media.anchors.clear();
  media.anchor_alias.clear();
  if (!HasAnchors(strategy, scene)) return;
  AliasTable table = BuildAliasTable(scene.lights.power);
  for (std::size_t i = 0; i < table.size(); ++i) {
    media.anchors.push_back(AnchorOf(scene.geometry, scene.lights.lights[i]));
    media.anchors.back().keep = table.q[i];
  }
  media.anchor_alias = std::move(table.alias);
}

}  // namespace lanelight
