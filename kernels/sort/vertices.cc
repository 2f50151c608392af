// All that scatters in one queue: surfaces after what is in it already. Only where
// something else than a surface scatters: otherwise kVertex is the surfaces' queue itself
// (src/path/wave.h).
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/sort/vertices.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void Vertices(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kSurface),
               [&](const Slots& slots, MF valid)
                   HWY_ATTR { Push(wave.queue(QueueId::kVertex), slots, valid); });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(Vertices);

Stage VerticesStage() {
  return {.name = "vertices",
          .meaning = "brings together all that scatters",
          .input = QueueId::kSurface,
          .needs = {Feature::kOtherEvents, Feature::kScatters},
          .resolve = [](const FeatureSet&) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(Vertices);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
