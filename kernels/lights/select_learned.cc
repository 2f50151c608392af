// light-selection=learned: by the table of the cell that the point lies in.
//   estimator   f(light) / pmf
//   unbiased    every light has pmf > 0 in every row: a fifth of it is by power
//   variance    of direct light with shadows, as far as cells are alike inside
//   cost        six gathers; with more than 64 lights, five more for one of its group
//   source      Vevoda, Kondapaneni and Krivanek 2018, "Bayesian online regression for
//               adaptive direct illumination sampling" (the idea; here one training pass)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/queue/grid_cell-inl.h"

LANELIGHT_BEGIN_KERNELS

// An item of an alias table: a bin, or the alias where the fraction says so.
struct Choice {
  VI bin;
  VF fraction;

  HWY_INLINE Choice(VF u, VI count) {
    const VF scaled = hn::Mul(u, hn::ConvertTo(DF(), count));
    bin = hn::Min(hn::ConvertTo(DI(), scaled), hn::Sub(count, hn::Set(DI(), 1)));
    fraction = hn::Sub(scaled, hn::ConvertTo(DF(), bin));
  }
  // Returns the choice, and makes a number in [0, 1) of what is left of the fraction.
  HWY_INLINE VI Take(VF q, VI own, VI alias) {
    const MF keep = hn::Lt(fraction, q);
    const VF one = Splat(1.0f);
    const VF start = hn::IfThenZeroElse(keep, q);
    const VF width = hn::IfThenElse(keep, q, hn::Sub(one, q));
    fraction = hn::Min(hn::Div(hn::Sub(fraction, start), width), Splat(0x1.fffffep-1f));
    return hn::IfThenElse(hn::RebindMask(DI(), keep), own, alias);
  }
};

// Returns a light of the group.
HWY_INLINE VI SelectMember(const LearnedLights& learned, VI group, VF u) {
  Choice member(u, Gather(learned.count.data(), group));
  const VI entry = hn::Add(Gather(learned.first.data(), group), member.bin);
  return member.Take(Gather(learned.member_q.data(), entry),
                     Gather(learned.member.data(), entry),
                     Gather(learned.member_alias.data(), entry));
}

void SelectLearnedLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const LearnedLights& learned = wave.run->tables->lights;
  const VI groups = hn::Set(DI(), static_cast<int32_t>(learned.num_groups));
  ForEachBatch(wave, wave.queue(QueueId::kLit), [&](const Slots& slots, MF) HWY_ATTR {
    const VI row = Gather(learned.row.data(), CellOf(learned.grid, p, slots));
    Choice group(Gather(p.u_select, slots), groups);
    const VI entry = hn::Add(hn::Mul(row, groups), group.bin);
    VI light = group.Take(Gather(learned.alias_q.data(), entry), group.bin,
                          Gather(learned.alias.data(), entry));
    if (learned.is_grouped) light = SelectMember(learned, light, group.fraction);
    Scatter(light, p.ls_light, slots);
    Scatter(row, p.light_row, slots);
  });
}

Stage SelectLearnedLightStage() {
  return {.name = "light_select_learned",
          .meaning = "chooses a light by the table of a cell",
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {Feature::kManyLights, Feature::kLearnedLights, Feature::kScatters},
          .reads =
              fields::kPoint | fields::kNormal | fields::kRay | FieldSet{Field::u_select},
          .writes = {Field::ls_light, Field::light_row},
          .resolve = Always<SelectLearnedLight>};
}

LANELIGHT_END_KERNELS
