// reuse=block: of glossy second vertices, once their light sample has been connected,
// where its light comes from and how much, and where the path goes on.
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/reuse/block-inl.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE void KeepLight(const Wave& wave, const Slots& slots, VI record) {
  const PathColumns& p = wave.path;
  const GlossyColumns& glossy = wave.block->glossy;
  if (p.ls_x != nullptr) {
    Scatter3(Gather3(p.ls_x, p.ls_y, p.ls_z, slots), glossy.light_x, glossy.light_y,
             glossy.light_z, record);
  }
  Scatter3(Gather3(p.d_x, p.d_y, p.d_z, slots), glossy.next_x, glossy.next_y,
           glossy.next_z, record);
  Scatter3(Gather3(p.l_r, p.l_g, p.l_b, slots), glossy.lit_r, glossy.lit_g, glossy.lit_b,
           record);
}

void SecondVerticesLight(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue& shaded =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        const VI state = Gather(p.reuse, slots);
        return hn::RebindMask(DF(), hn::Eq(state, StateLanes(ReuseState::kGlossy)));
      });
  ForEachBatch(wave, shaded, [&](const Slots& slots, MF) HWY_ATTR {
    const VI record = RecordOf(wave.work, Gather(p.output, slots));
    KeepLight(wave, slots, record);
    const MF mirrored = hn::Le(Gather(p.bsdf_pdf, slots), hn::Zero(DF()));
    const VI state =
        hn::IfThenElse(hn::RebindMask(DI(), mirrored), StateLanes(ReuseState::kMirrored),
                       StateLanes(ReuseState::kOnward));
    Scatter(state, p.reuse, slots);
    Scatter(state, wave.block->second.state, record);
  });
}

Stage SecondVerticesLightStage() {
  using namespace fields;
  return {.name = "reuse_light",
          .meaning = "keeps what lights glossy second vertices",
          .input = QueueId::kVertex,
          .role = StageRole::kRecord,
          .needs = {Feature::kReuseGlossy, Feature::kScatters},
          .reads = kRadiance | kLightSample |
                   FieldSet{Field::output, Field::bsdf_pdf, Field::reuse, Field::d_x,
                            Field::d_y, Field::d_z},
          .writes = {Field::reuse},
          .resolve = Always<SecondVerticesLight>};
}

LANELIGHT_END_KERNELS
