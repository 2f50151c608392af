// Single rays through the intersection kernels of a scene, without camera, materials or
// light: where they hit, and whether rays that leave a hit are stopped.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"
#include "src/render/job/job.h"

namespace lanelight::stress {

/// A ray in the coordinates of the scene file; `direction` is of unit length.
struct WorldRay {
  Vec3d origin, direction;
};

/// What a ray hits, in the coordinates of the scene file.
struct WorldHit {
  bool found = false;
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t primitive = 0;  // id in src/scene/geometry/geometry.h
  Vec3d point, normal;          // as shading sees them; zero without a hit
};

/// Runs the closest-hit, surface and shadow stages that the plan of a scene has, on a
/// SIMD target. The scene needs a light, or it has no shadow stages.
class RayTracer {
 public:
  /// Compiles and plans the scene (pbrt text, no files). Throws InputError.
  RayTracer(SimdTarget target, const std::string& text);

  /// Closest hits and their surfaces.
  std::vector<WorldHit> Trace(const std::vector<WorldRay>& rays);

  /// True for each direction (unit) whose ray, leaving the hit of the ray of the same
  /// number in the last Trace, meets anything within `length` (scene-file units). Rays
  /// start where shading starts them. Without a hit there the answer is false.
  std::vector<bool> Blocked(const std::vector<Vec3d>& directions,
                            double length = std::numeric_limits<double>::infinity());

  /// The ray that the kernels get: rounded to float in the frame of the scene.
  WorldRay Rounded(const WorldRay& ray) const;
  const CompiledScene& scene() const { return *job_.scene.compiled; }

 private:
  void Allocate(std::size_t rays);
  void RunStages(const char* prefix);
  void PutRay(std::uint32_t slot, const WorldRay& ray);
  WorldHit HitOf(std::uint32_t slot) const;

  Job job_;
  RunParameters run_;
  Wave wave_;
  std::uint32_t rays_ = 0;  // of the last Trace
  std::vector<AlignedVector<std::uint32_t>> storage_;
};

}  // namespace lanelight::stress
