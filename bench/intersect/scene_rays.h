// The rays of a real render, taken from the queues of its wavefronts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/intersect/ray_sets.h"

namespace lanelight::bench {

struct SceneRays {
  std::shared_ptr<const CompiledScene> scene;
  Mesh mesh;                 // its world triangles
  std::vector<RaySet> sets;  // "closest" and "shadow", wave by wave
};

/// Renders the scene with kRecordedSpp samples per pixel on one thread and copies what
/// stands in the queues before the stages that intersect triangles: origin, direction and
/// distance of the rays in the order in which they are traced. Of each kind every n-th
/// wave is taken, so that there are about `max_rays` rays. Waves of a render mix depths:
/// paths that end are replaced at once. Cut-outs are left out in the replay: all
/// triangles are opaque. Throws InputError for scenes with instances or without
/// triangles.
SceneRays RecordRays(const std::string& path, std::size_t max_rays);

inline constexpr std::uint64_t kRecordedSpp = 8;

}  // namespace lanelight::bench
