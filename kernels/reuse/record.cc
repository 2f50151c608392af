// reuse=block: keeps the first vertex of a path, and the second one.
//
// The first is where the path meets a material that kReceiving names, behind mirrors and
// clear glass if need be: a property of the vertex, not of what is sampled there. The
// second is what it meets next, if it left the first by a density. So first and second
// vertices part the space of paths, whatever the samples are.
//
// A second vertex whose material kEvenSides names sends the same light to all directions
// on a side, so that others may look at it as well: what the path gathers from there on
// is kept apart from what it had, by a path of its own with a throughput that begins
// with 1.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/reuse/record.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/filter-inl.h"
#include "kernels/reuse/block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

HWY_INLINE MF IsOfKinds(const Wave& wave, const Slots& slots, uint32_t kinds) {
  const DU du;
  const VI kind = Lookup(wave.scene->materials.kind, Gather(wave.path.material, slots));
  const VU bit = hn::Shl(hn::Set(du, 1u), hn::BitCast(du, kind));
  return hn::RebindMask(DF(), hn::Ne(hn::And(bit, hn::Set(du, kinds)), hn::Zero(du)));
}

HWY_INLINE MF IsIn(const Wave& wave, const Slots& slots, ReuseState state) {
  const VI mine = Gather(wave.path.reuse, slots);
  return hn::RebindMask(DF(), hn::Eq(mine, StateLanes(state)));
}

HWY_INLINE void SetState(const Wave& wave, const Slots& slots, VI record,
                         ReuseState state) {
  Scatter(StateLanes(state), wave.path.reuse, slots);
  Scatter(StateLanes(state), wave.block->second.state, record);
}

HWY_INLINE VI RecordsOf(const Wave& wave, const Slots& slots) {
  return RecordOf(wave.work, Gather(wave.path.output, slots));
}

HWY_INLINE void KeepSecond(const Wave& wave, const Slots& slots, VI record) {
  const PathColumns& p = wave.path;
  const ReuseColumns& second = wave.block->second;
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
  const auto facing = [&](V3 n) HWY_ATTR {
    return IfThenElse(hn::Gt(Dot(n, d), hn::Zero(DF())), -n, n);
  };
  const V3 ng = facing(Gather3(p.ng_x, p.ng_y, p.ng_z, slots));
  const V3 ns = p.ns_x == nullptr ? ng : facing(Gather3(p.ns_x, p.ns_y, p.ns_z, slots));
  const V3 at = Gather3(p.p_x, p.p_y, p.p_z, slots);
  Scatter3(at, second.x, second.y, second.z, record);
  Scatter(Gather(p.p_error, slots), second.p_error, record);
  Scatter3(ng, second.ng_x, second.ng_y, second.ng_z, record);
  Scatter3(ns, second.ns_x, second.ns_y, second.ns_z, record);
  const V3 before = Gather3(p.l_r, p.l_g, p.l_b, slots);
  Scatter3(before, second.before_r, second.before_g, second.before_b, record);
}

HWY_INLINE void BeginSuffix(const PathColumns& p, const StoreSlots& slots) {
  Scatter3(Splat3(0, 0, 0), p.l_r, p.l_g, p.l_b, slots);
  Scatter3(Splat3(1, 1, 1), p.beta_r, p.beta_g, p.beta_b, slots);
  if (p.eta_scale != nullptr) Scatter(Splat(1.0f), p.eta_scale, slots);
}

HWY_INLINE void RecordSeconds(Wave& wave) {
  const Queue& vertices = wave.queue(QueueId::kVertex);
  const Queue& serving = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    const MF found = hn::Gt(Gather(wave.path.bsdf_pdf, slots), hn::Zero(DF()));
    return hn::And(hn::And(IsIn(wave, slots, ReuseState::kFirst), found),
                   IsOfKinds(wave, slots, kEvenSidedKinds));
  });
  ForEachBatch(wave, serving, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    KeepSecond(wave, slots, record);
    BeginSuffix(wave.path, slots);
    SetState(wave, slots, record, ReuseState::kSecond);
  });
  const Queue& others = FilterQueue(wave, vertices, [&](const Slots& slots) HWY_ATTR {
    return IsIn(wave, slots, ReuseState::kFirst);
  });
  ForEachBatch(wave, others, [&](const Slots& slots, MF) HWY_ATTR {
    SetState(wave, slots, RecordsOf(wave, slots), ReuseState::kOwn);
  });
}

// All that the evaluation of a material reads, as it is before the path scatters. The
// last batch may store a path twice, from before its state is changed as from after.
HWY_INLINE void RecordFirsts(Wave& wave) {
  const Block& block = *wave.block;
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        return hn::And(IsIn(wave, slots, ReuseState::kNoVertex),
                       IsOfKinds(wave, slots, kReceivingKinds));
      });
  ForEachBatch(wave, mine, [&](const Slots& slots, MF) HWY_ATTR {
    const VI record = RecordsOf(wave, slots);
    for (uint32_t c = 0; c < block.num_columns; ++c) {
      Scatter(Gather(block.from[c], slots), block.to[c], record);
    }
    SetState(wave, slots, record, ReuseState::kFirst);
  });
}

// Seconds first: a vertex is not both.
void RecordReuse(Wave& wave) {
  RecordSeconds(wave);
  RecordFirsts(wave);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(RecordReuse);

Stage RecordReuseStage() {
  using namespace fields;
  const FieldSet state = {Field::reuse, Field::eta_scale};
  return {.name = "reuse_record",
          .meaning = "keeps first and second vertices of paths for their block",
          .input = QueueId::kVertex,
          .needs = {Feature::kReuse, Feature::kScatters},
          .reads = FirstVertexFields() | kRadiance | state |
                   FieldSet{Field::output, Field::bsdf_pdf},
          .writes = kRadiance | kThroughput | state,
          .resolve = [](const FeatureSet&) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(RecordReuse);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
