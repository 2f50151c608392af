// light-selection=power, uniform: by the table of the scene (Walker's alias method).
//   estimator   f(light) / pmf(light), pmf of LightChances
//   unbiased    every light has pmf > 0
//   variance    zero only if every light's contribution is in proportion to its pmf: no
//               notion of distance, so poor for many small lights
//   cost        two gathers
//   source      Walker 1977; Vose 1991
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/rng-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

// The number chooses a bin, and its fraction chooses between the bin's light and its
// alias. With many lights the fraction has few of the 24 bits: with a million, 16 steps,
// which select a light of a hundredth of the mean six times too often. A lattice whose
// step is a multiple of 1 / n has the same fraction in every bin. A different shift per
// bin keeps fractions uniform and removes both errors in the mean of all bins.
HWY_INLINE VF TurnFraction(VF fraction, VI bin, uint32_t step) {
  const VU turn = hn::Mul(AsUnsigned(bin), SplatU(step));
  const VF sum = hn::Add(fraction, ToUnit(turn));
  return hn::IfThenElse(hn::Ge(sum, Splat(1.0f)), hn::Sub(sum, Splat(1.0f)), sum);
}

void SelectLight(Wave& wave) {
  const DI di;
  const LightChances& table = *wave.chances;
  const VF count = Splat(static_cast<float>(table.alias.size()));
  const VI last = hn::Set(di, static_cast<int32_t>(table.alias.size()) - 1);
  // The golden ratio of 2^32; few lights keep the order of their strata.
  const uint32_t step = table.alias.size() > 64 ? 0x9e3779b9u : 0;
  ForEachBatch(wave, wave.queue(QueueId::kLit), [&](const Slots& slots, MF) HWY_ATTR {
    const VF scaled = hn::Mul(Gather(wave.path.u_select, slots), count);
    const VI bin = hn::Min(hn::ConvertTo(di, scaled), last);
    const VF fraction =
        TurnFraction(hn::Sub(scaled, hn::ConvertTo(DF(), bin)), bin, step);
    const auto keep =
        hn::RebindMask(di, hn::Lt(fraction, Gather(table.alias_q.data(), bin)));
    Scatter(hn::IfThenElse(keep, bin, Gather(table.alias.data(), bin)),
            wave.path.ls_light, slots);
  });
}

Stage SelectLightStage() {
  return {.name = "light_select_table",
          .meaning = "chooses a light by the table",
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {Feature::kManyLights, Feature::kLightTable, Feature::kScatters},
          .reads = {Field::u_select},
          .writes = {Field::ls_light},
          .resolve = Always<SelectLight>};
}

LANELIGHT_END_KERNELS
