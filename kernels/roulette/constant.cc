// roulette=constant:q: every path ends with the same probability q.
//   estimator   f / (1 - q) for survivors, 0 for the others (the paper's equation 8)
//   unbiased    q < 1
//   variance    independent of the throughput: in a closed room of albedo a there are
//               1/q events in the mean, geometrically distributed, and the variance of
//               the sum is finite only for a^2 < 1 - q
//   from        the first scattering event on (constant:Q:FIRST)
//   cost        one division and a compaction
//   source      Arvo and Kirk 1990; Maughan, equation 8
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/survive-inl.h"

LANELIGHT_BEGIN_KERNELS

struct ConstantSurvival {
  static HWY_INLINE VF Survival(const Wave& wave, VI, V3) {
    return Splat(1.0f - wave.run->roulette.termination);
  }
};

Stage ConstantRouletteStage() {
  return RouletteStage<ConstantSurvival>("roulette_constant",
                                         "Russian roulette of constant probability",
                                         Feature::kConstantRoulette);
}

LANELIGHT_END_KERNELS
