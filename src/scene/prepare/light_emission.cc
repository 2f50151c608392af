#include "src/scene/prepare/light_emission.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "src/base/core/alias_table.h"
#include "src/scene/prepare/light_media.h"

namespace lanelight {
namespace {

// Returns whether no infinite plane has alpha. Kernels find planes between the disk where
// subpaths start and a light at infinity, but do not look up their alpha.
bool PlanesAreWhole(const CompiledScene& scene) {
  const AlphaTable& alpha = scene.alpha;
  const PrimitiveRanges& ranges = scene.geometry.ranges;
  if (alpha.constant.empty()) return true;
  for (std::size_t i = ranges.planes; i < ranges.large_spheres; ++i) {
    if (alpha.texture[i] >= 0 || alpha.constant[i] < 1) return false;
  }
  return true;
}

// `has_disk`: on which subpaths from infinity can start.
bool StartsSubpaths(const LightTable& table, bool has_disk, const LightRecord& light) {
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle:
    case LightShape::kRectangle:
    case LightShape::kSphere:
    case LightShape::kDisk:
    case LightShape::kPoint:
    case LightShape::kGoniometric:
      return true;
    case LightShape::kSpot:
    case LightShape::kProjection:
      return light.size[0] > 0;
    case LightShape::kDistant:
      return has_disk;
    case LightShape::kInfiniteConstant:
    case LightShape::kInfiniteImage:
      return has_disk && table.portals.empty();
    case LightShape::kPortal:
    case LightShape::kCount:
      break;
  }
  return false;
}

bool HasPosition(LightShape shape) {
  return HasTrait(shape, kDeltaLight) && !HasTrait(shape, kFarLight);
}

// Returns the share of a light's power that subpaths carry: those of lights outside the
// scene start in the cone around it (StartCone, kernels/light_paths/starts-inl.h).
double ShareOfPower(const CompiledScene& scene, const LightRecord& light) {
  const LightTable& table = scene.lights;
  if (!HasPosition(static_cast<LightShape>(light.shape))) return 1;
  if (!scene.geometry.planes.empty()) return 1;
  const double own = light.size[0] > 0 ? double(light.size[0]) : 2;
  const double radius = double(table.radius);
  double d2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = double(light.position[i]) - double(table.center[i]);
    d2 += d * d;
  }
  if (d2 <= radius * radius || radius == 0) return 1;
  const double sin2 = radius * radius / d2;
  return std::min(1.0, sin2 / (1 + std::sqrt(1 - sin2)) / own);
}

}  // namespace

LightEmission MakeLightEmission(const CompiledScene& scene) {
  const LightTable& table = scene.lights;
  const bool has_disk = table.radius > 0 && PlanesAreWhole(scene);
  LightEmission emission;
  std::vector<double> weights(table.lights.size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const LightRecord& light = table.lights[i];
    if (!StartsSubpaths(table, has_disk, light) || IsUnseen(scene, light)) continue;
    weights[i] = table.power[i] * ShareOfPower(scene, light);
  }
  if (!scene.media.media.empty()) emission.media = FindLightMedia(scene, weights);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const LightRecord& light = table.lights[i];
    if (weights[i] == 0) continue;
    emission.shapes |= 1u << light.shape;
    if (light.area > 0 && light.image != 0) emission.has_images = true;
    if (IsCut(scene, light)) emission.has_cuts = true;
  }
  if (emission.shapes == 0) return emission;
  AliasTable chances = BuildAliasTable(weights);
  emission.pmf = std::move(chances.probability);
  emission.alias_q = std::move(chances.q);
  emission.alias = std::move(chances.alias);
  return emission;
}

}  // namespace lanelight
