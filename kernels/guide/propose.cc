// guiding=radiance: the cell of the guide that a path is in and, where the guide and not
// the material is to choose (u_guide below the cell's fraction), the direction that it
// proposes. What becomes of both: kernels/directions/guided-inl.h.
//   density     that of the square of the direction (src/prepare/guide_square.h)
//   cost        the levels of the tree; eight gathers and a map per direction, which
//               batches in which no path is guided skip. In a render with a guide of 1000
//               cells, 2 MB, about 35 ns per path (AVX-512), most of it spent waiting for
//               what is not in L1
//   source      Mueller, Gross and Novak 2017, "Practical Path Guiding for Efficient
//               Light-Transport Simulation"
#include "kernels/simd/each_target-inl.h"

#include "kernels/guide/guide-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

void GuideProposals(Wave& wave) {
  const PathColumns& p = wave.path;
  const Guide& guide = wave.run->tables->guide;
  const GuideTop top(guide);
  ForEachBatch(
      wave, wave.queue(QueueId::kVertex), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
        V3 n = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
        n = IfThenElse(hn::Gt(Dot(n, d), hn::Zero(DF())), -n, n);
        const VI cell = GuideCell(guide, top, Gather3(p.p_x, p.p_y, p.p_z, slots), n);
        Scatter(cell, p.guide_cell, slots);
        const VF fraction = Gather(guide.fraction.data(), cell);
        // Who is not guided has no use for the direction.
        if (hn::AllFalse(DF(), hn::Lt(Gather(p.u_guide, slots), fraction))) return;
        const GuideSample sample = SampleGuide(guide, cell, Gather(p.u_bsdf_0, slots),
                                               Gather(p.u_bsdf_1, slots));
        Scatter3(GuideFrame(n).FromLocal(sample.direction), p.guide_x, p.guide_y,
                 p.guide_z, slots);
        Scatter(sample.pdf_sa, p.guide_pdf, slots);
      });
}

Stage GuideProposalsStage() {
  using namespace fields;
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  const FieldSet normal = {Field::ng_x, Field::ng_y, Field::ng_z};
  return {
      .name = "guide",
      .meaning = "what is known of the light at a point, and the direction it proposes",
      .input = QueueId::kVertex,
      .needs = {Feature::kGuided, Feature::kScatters},
      .reads = direction | normal | kPoint |
               FieldSet{Field::u_guide, Field::u_bsdf_0, Field::u_bsdf_1},
      .writes = kGuideProposal,
      .resolve = Always<GuideProposals>};
}

LANELIGHT_END_KERNELS
