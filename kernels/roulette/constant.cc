// roulette=constant:q: every path ends with the same probability q.
//   estimator   f / (1 - q) for survivors, 0 for the others (the paper's equation 8)
//   unbiased    q < 1
//   variance    blind to what the path carries: in a closed room of albedo a there are
//               1/q events in the mean, geometrically distributed, and the variance of
//               the sum is finite only while a^2 < 1 - q
//   from        the first scattering event on (constant:Q:FIRST)
//   cost        one division and a compaction
//   source      Arvo and Kirk 1990; Maughan, equation 8
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/roulette/constant.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/roulette/survive-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct ConstantSurvival {
  static HWY_INLINE VF Survival(const Wave& wave, VI, V3) {
    return Splat(1.0f - wave.run->roulette.termination);
  }
};

void ConstantRoulette(Wave& wave) { PlayRoulette<ConstantSurvival>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/roulette/roulette_stage.h"

namespace lanelight {

HWY_EXPORT(ConstantRoulette);

Stage ConstantRouletteStage() {
  return RouletteStage("roulette_constant", "Russian roulette of constant probability",
                       Feature::kConstantRoulette, [](const FeatureSet&) -> StageFn {
                         return HWY_DYNAMIC_DISPATCH(ConstantRoulette);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
