// roulette=efficiency: the factors that maximise 1 / (variance x cost) of the image, a
// fixed point of the variance and cost that result from them.
//   split       s = |beta / I| sqrt(V / C) sqrt(C_I / V_I): V variance per unit of
//               throughput from here on, C its cost in rays (a coarse cache over
//               space and orientation); I brightness of the pixel, || the root mean
//               square over channels; V_I relative variance and C_I cost of a camera
//               path, the same for all pixels
//   roulette    t: the same with the second moment for the variance (a path that ends
//               loses its mean as well)
//   estimator   r = s if s > 1, t if t < 1, else 1; window-inl.h. (s <= t, so at most one
//               of them holds)
//   unbiased    for any values: they only steer r; the training's samples are not used
//   variance    splits paths whose variance is large and cheap to reduce, ends paths
//               whose variance is small for their rays. C_I / V_I is iterated in short
//               training passes (src/render/train/train_path_values.cc)
//   fallback    the last passes compare with no roulette and with roulette on the
//               throughput; the best of the three renders the image
//   cost        three gathers of tables and a hash per vertex; the training passes
//   source      Rath, Grittmann, Herholz, Weier and Slusallek 2022, "EARS: Efficiency-
//               Aware Russian Roulette and Splitting"
#include "kernels/simd/each_target-inl.h"

#include "kernels/roulette/window-inl.h"

LANELIGHT_BEGIN_KERNELS

struct EfficiencyWindow {
  static HWY_INLINE VF Factor(const Wave& wave, const Slots& slots, V3 beta) {
    const PathValues& values = wave.run->tables->path_values;
    const VI cell = CellOf(values.grid, wave.path, slots);
    const VF weight = hn::Mul(WeightInImage(wave, slots, beta), Splat(values.scale));
    const VF survive = Gather(values.survive.data(), cell);
    const VF s = hn::Mul(weight, Gather(values.split.data(), cell));
    const VF t = hn::Mul(weight, survive);
    const VF one = Splat(1.0f);
    const VF r = hn::IfThenElse(hn::Gt(s, one), s, hn::Min(t, one));
    const MF known = hn::Ge(survive, hn::Zero(DF()));
    return hn::IfThenElse(known, r, ThroughputFactor(wave.path, slots, beta));
  }
};

Stage EfficiencyRouletteStage() {
  return WindowStage<EfficiencyWindow>("roulette_efficiency",
                                       "plays roulette and splitting for efficiency",
                                       Feature::kEfficiencyRoulette);
}

LANELIGHT_END_KERNELS
