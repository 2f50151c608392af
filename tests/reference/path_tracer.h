// The obvious scalar path tracer: double precision, plain loops, brute-force
// intersection, its own formulas, straight from the typed scene description. It shares no
// code with the kernels, and is what they are compared with.
//
// Two estimators that have little in common: agreement between them is evidence for both.
#pragma once

#include <optional>
#include <vector>

#include "src/scene/description/description.h"
#include "tests/reference/geometry.h"
#include "tests/reference/lights.h"
#include "tests/reference/bump_maps.h"

namespace lanelight {

/// What can be rendered: every shape, material and light of SceneDescription, except
/// `interface` inside a mix, emitting planes, and the signed filters; these raise
/// CheckFailure. Rays that cross an emitting `interface` go on without a scattering
/// event.
enum class ReferenceEstimator {
  /// Directions come from the material alone; point, spot and distant lights, which no
  /// direction can hit, are connected to directly.
  kMaterialSampling,
  /// Each vertex connects to the delta lights and to one point, uniform by area, on each
  /// other light; emission met on the way counts only at depth 0 and after specular
  /// events.
  kLightSampling
};

struct TwinOptions {
  ReferenceEstimator estimator = ReferenceEstimator::kLightSampling;
  int samples = 64;  // per pixel
  std::uint64_t seed = 1;
  std::optional<int> max_depth;              // overrides the scene's
  reference::TextureLookup texture;          // needed if the scene has textures
  reference::NormalMapLookup normal_map;     // needed if it has normal maps
  reference::EnvironmentLookup environment;  // needed if it has environment images
};

/// Row by row, from the upper left pixel of the crop window.
struct ReferenceImage {
  int width = 0, height = 0;
  int samples = 0;  // independent samples per pixel
  std::vector<Rgb> mean, variance_of_mean;
  const Rgb& Mean(int x, int y) const { return mean[y * width + x]; }
};

ReferenceImage RenderReference(const SceneDescription& scene,
                               const TwinOptions& options = {});

/// Radiance that arrives along one ray: one sample.
Rgb ReferenceRadiance(const SceneDescription& scene, const reference::Geometry& geometry,
                      const reference::Lights& lights, reference::Ray ray,
                      const TwinOptions& options, reference::Random& random);

}  // namespace lanelight
