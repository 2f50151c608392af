// Running the intersect stages on lists of rays.
#pragma once

#include <vector>

#include "kernels/stages.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {

struct KernelHit {
  float t;
  std::uint32_t prim;
  float b1, b2;
  std::uint32_t inst;
  friend bool operator==(const KernelHit&, const KernelHit&) = default;
};

/// Runs closest-hit stages in order; misses have t = inf and zeros.
inline std::vector<KernelHit> TraceClosest(const CompiledScene& scene,
                                           const std::vector<TestRay>& rays,
                                           const std::vector<StageOn>& stages,
                                           const FeatureSet& features = {}) {
  WaveFixture fixture(scene, static_cast<std::uint32_t>(rays.size()));
  const PathColumns& p = fixture.wave.path;
  for (std::size_t i = 0; i < rays.size(); ++i) p.b1[i] = p.b2[i] = 0;
  fixture.SetRays(rays);
  for (const StageOn stage : stages) fixture.Run(stage, features);
  std::vector<KernelHit> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::isinf(p.t[i])) {
      hits.push_back({p.t[i], 0, 0, 0, 0});
    } else {
      hits.push_back({p.t[i], p.prim[i], p.b1[i], p.b2[i], p.inst[i]});
    }
  }
  return hits;
}

/// Runs shadow stages; the indices of the rays that stay in the queue, in its order.
inline std::vector<std::uint32_t> Unoccluded(const CompiledScene& scene,
                                             const std::vector<TestRay>& rays,
                                             const std::vector<StageOn>& stages,
                                             const FeatureSet& features = {}) {
  WaveFixture fixture(scene, static_cast<std::uint32_t>(rays.size()));
  fixture.SetShadowRays(rays);
  for (const StageOn stage : stages) fixture.Run(stage, features);
  const Queue& queue = fixture.wave.queue(QueueId::kShadow);
  return {queue.items, queue.items + queue.size};
}

}  // namespace lanelight
