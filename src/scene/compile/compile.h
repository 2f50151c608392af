// SceneDescription (double precision, file units) to CompiledScene (what kernels read).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

struct CompiledScene;     // src/scene/compiled/scene.h
struct CachedBvh;         // src/scene/accel/build.h
struct SceneDescription;  // src/scene/description/description.h
struct BvhReport;         // src/scene/accel/bvh_report.h

struct CompileOptions {
  std::optional<Scattering> scattering;  // overrides every diffuse material
  BuildQuality build = BuildQuality::kHigh;
  int leaf_triangles = kLeafTriangles;  // as in AccelOptions
  /// As in PlaceShapes.
  std::uint64_t copied_triangles = 0;
  const CachedBvh* cached_bvh = nullptr;  // may be of the same shapes; may be null
  BvhReport* bvh_report = nullptr;        // filled in; may be null
};

/// Throws InputError if the scene cannot be rendered (a missing image, a shape that the
/// renderer cannot represent), with the place in the file that asked for it.
/// Loads the image files that textures and environments name.
CompiledScene CompileScene(const SceneDescription& description,
                           const CompileOptions& options = {});

/// The trees of a scene, for another one that may have the same shapes.
std::shared_ptr<const CachedBvh> CachedBvhOf(const CompiledScene& scene);

}  // namespace lanelight
