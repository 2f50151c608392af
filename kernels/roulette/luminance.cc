// roulette=luminance: a path survives with probability s = min(1, max(floor, luminance of
// its throughput)), the factor eta^2 of refractions undone.
//   estimator   survive-inl.h
//   unbiased    s >= floor or above 0
//   variance    spends less than `throughput` on saturated paths, which are hardly
//               visible; the floor of 0.05 bounds the weight of dark blue survivors
//   from        the second scattering event on (luminance:FLOOR:FIRST)
//   cost        one division and a compaction
//   source      Arvo and Kirk 1990, "Particle Transport and Image Synthesis"
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/survive-inl.h"

LANELIGHT_BEGIN_KERNELS

struct LuminanceSurvival {
  static HWY_INLINE VF Survival(const Wave& wave, const Slots& slots, V3 beta) {
    const VF y = hn::MulAdd(
        beta.x, Splat(0.212671f),
        hn::MulAdd(beta.y, Splat(0.715160f), hn::Mul(beta.z, Splat(0.072169f))));
    return hn::Max(WithoutRefraction(wave.path, slots, y),
                   Splat(HWY_MAX(wave.run->roulette.floor, 1e-6f)));
  }
};

Stage LuminanceRouletteStage() {
  return RouletteStage<LuminanceSurvival>("roulette_luminance",
                                          "Russian roulette on the luminance",
                                          Feature::kLuminanceRoulette);
}

LANELIGHT_END_KERNELS
