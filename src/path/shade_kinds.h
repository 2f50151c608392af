// The kinds of materials that have a shading kernel.
#pragma once

#include <cstdint>

#include "src/path/features.h"

namespace lanelight {

/// The shading kernels, one queue each.
#define LANELIGHT_SHADE_KINDS(X)                                                  \
  X(kDiffuse)                                                                     \
  X(kDiffuseUniform)                                                              \
  X(kDiffuseInSphere)                                                             \
  X(kConductorSmooth) X(kConductorRough) X(kDielectricSmooth) X(kDielectricRough) \
      X(kThinDielectric) X(kCoatedDiffuseSmooth) X(kCoatedDiffuseRough)           \
          X(kCoatedConductor) X(kDiffuseTransmission)

enum class ShadeKind : std::uint32_t {
#define X(name) name,
  LANELIGHT_SHADE_KINDS(X)
#undef X
      kCount,
  kMix = kCount  // resolved by the mix stage, has no queue
};
inline constexpr int kNumShadeKinds = static_cast<int>(ShadeKind::kCount);

/// The feature that says that a scene has this kind.
constexpr Feature ShadeFeature(ShadeKind kind) {
  constexpr Feature kFeatures[] = {
#define X(name) Feature::name,
      LANELIGHT_SHADE_KINDS(X)
#undef X
  };
  return kFeatures[static_cast<int>(kind)];
}

}  // namespace lanelight
