// Appends surface hits to the queue of all scattering events. If only surfaces scatter,
// kVertex is the surface queue itself (src/vocabulary/path/wave.h).
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

void Vertices(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kSurface),
               [&](const Slots& slots, MF valid)
                   HWY_ATTR { Push(wave.queue(QueueId::kVertex), slots, valid); });
}

Stage VerticesStage() {
  return {.name = "vertices",
          .meaning = "brings together all that scatters",
          .input = QueueId::kSurface,
          .role = StageRole::kSort,
          .needs = {Feature::kOtherEvents, Feature::kScatters},
          .resolve = Always<Vertices>};
}

LANELIGHT_END_KERNELS
