// roulette=throughput: a path survives with probability s = min(1, max(floor, scale times
// the largest component of its throughput)), the factor eta^2 of refractions undone.
//   estimator   survive-inl.h
//   unbiased    s > 0: a scattered path has a positive component
//   variance    bounded weights: a survivor's throughput is at most 1 after division, and
//               at most 1 / scale if it was below: a larger scale makes paths more even,
//               and more of them long
//   from        the second scattering event on, as in pbrt-v4
//               (throughput:FLOOR:FIRST:SCALE)
//   cost        one division and a compaction
//   source      Arvo and Kirk 1990, "Particle Transport and Image Synthesis"
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/survive-inl.h"

LANELIGHT_BEGIN_KERNELS

struct ThroughputSurvival {
  static HWY_INLINE VF Survival(const Wave& wave, const Slots& slots, V3 beta) {
    const VF s = WithoutRefraction(wave.path, slots, MaxComponent(beta));
    const RouletteParameters& roulette = wave.run->roulette;
    return hn::Max(hn::Mul(s, Splat(roulette.scale)), Splat(roulette.floor));
  }
};

Stage ThroughputRouletteStage() {
  return RouletteStage<ThroughputSurvival>("roulette_throughput",
                                           "Russian roulette on the throughput",
                                           Feature::kThroughputRoulette);
}

LANELIGHT_END_KERNELS
