// Adds the radiance of unoccluded shadow rays. A path has at most one per bounce.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/accumulate/connect.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void Connect(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kShadow), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 sum =
            Gather3(p.l_r, p.l_g, p.l_b, slots) + Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
        Scatter3(sum, p.l_r, p.l_g, p.l_b, slots);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(Connect);

Stage ConnectStage() {
  return {.name = "connect",
          .meaning = "adds the light of unoccluded shadow rays",
          .input = QueueId::kShadow,
          .needs = {Feature::kLights, Feature::kScatters},
          .reads = fields::kRadiance | fields::kShadow,
          .writes = fields::kRadiance,
          .resolve = [](const FeatureSet&) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(Connect);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
