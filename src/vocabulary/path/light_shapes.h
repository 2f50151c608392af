// The shapes of lights, with what the rest of the program must know of each. A shape has
// the feature of its line, and stages of it ask for that (docs/recipes.md).
#pragma once

#include <cstdint>
#include <iterator>

#include "src/vocabulary/path/features.h"

namespace lanelight {

/// Traits of a shape of light.
enum LightTraits : std::uint32_t {
  kEmittingShape = 1 << 0,  // of the scene, with an area
  kDeltaLight = 1 << 1,     // no ray can hit it: light samples are the only way there
  kFarLight = 1 << 2,       // stands at no place
};

// X(name, feature, traits)
// clang-format off
#define LANELIGHT_LIGHT_SHAPES(X)                                             \
  X(Triangle, TriangleLights, kEmittingShape)                                 \
  X(Sphere, SphereLights, kEmittingShape)                                     \
  X(Disk, DiskLights, kEmittingShape)                                         \
  X(Point, PointLights, kDeltaLight)                                          \
  X(Spot, SpotLights, kDeltaLight)                                            \
  X(Distant, DistantLights, kDeltaLight | kFarLight)                          \
  X(InfiniteConstant, InfiniteConstant, kFarLight)                            \
  X(InfiniteImage, InfiniteImage, kFarLight)                                  \
  /* two triangles of a mesh, which rays hit */                               \
  X(Rectangle, RectangleLights, kEmittingShape)                               \
  X(Goniometric, ImageLights, kDeltaLight)                                    \
  X(Projection, ImageLights, kDeltaLight)                                     \
  X(Portal, Portals, kFarLight)
// clang-format on

enum class LightShape : std::uint32_t {
#define X(name, feature, traits) k##name,
  LANELIGHT_LIGHT_SHAPES(X)
#undef X
      kCount
};

/// Returns the feature of a shape of light.
constexpr Feature LightFeature(LightShape shape) {
  constexpr Feature kFeatures[] = {
#define X(name, feature, traits) Feature::k##feature,
      LANELIGHT_LIGHT_SHAPES(X)
#undef X
  };
  return kFeatures[static_cast<int>(shape)];
}

constexpr bool HasTrait(LightShape shape, LightTraits trait) {
  constexpr std::uint32_t kTraits[] = {
#define X(name, feature, traits) traits,
      LANELIGHT_LIGHT_SHAPES(X)
#undef X
  };
  return (kTraits[static_cast<int>(shape)] & trait) != 0;
}

/// Returns the features of the shapes with a trait.
constexpr FeatureSet LightsWith(LightTraits trait) {
  FeatureSet features;
  for (int i = 0; i < static_cast<int>(LightShape::kCount); ++i) {
    const auto shape = static_cast<LightShape>(i);
    if (HasTrait(shape, trait)) features.Add(LightFeature(shape));
  }
  return features;
}

}  // namespace lanelight
