// Adds the radiance of unoccluded shadow rays. A path has at most one per bounce.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

void Connect(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kShadow), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 sum =
            Gather3(p.l_r, p.l_g, p.l_b, slots) + Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
        Scatter3(sum, p.l_r, p.l_g, p.l_b, slots);
      });
}

Stage ConnectStage() {
  return {.name = "connect",
          .meaning = "adds the light of unoccluded shadow rays",
          .input = QueueId::kShadow,
          .role = StageRole::kAccumulate,
          .needs = {Feature::kLights, Feature::kScatters},
          .reads = fields::kRadiance | fields::kShadow,
          .writes = fields::kRadiance,
          .resolve = Always<Connect>};
}

LANELIGHT_END_KERNELS
