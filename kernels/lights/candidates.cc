// light-candidates=resampled:M: keeps one of M light samples of a vertex and traces it.
// The stages between the two of this file make and consider one candidate; the driver
// runs them M times (src/render/wave/task_runner.cc).
//   estimator   f(y) V(y) / v(y) 1/M sum v(x_i), y = x_i with probability in proportion
//               to its worth v(x_i): what it would add unshadowed, over its density p
//               (kernels/shade/consider.cc)
//   candidates  the first has the numbers of the sample points; each further one those of
//               the one before, shifted by a constant step modulo 1: each candidate is
//               distributed as a single light sample, and together they fill the lights
//               evenly
//   density     ls_pdf stays that of one candidate: each is weighted against scattered
//               rays as a single light sample would be, and resampling estimates the mean
//               of such terms, whose expectation is that of each
//   unbiased    v > 0 wherever a candidate may add light; candidates may depend on each
//               other: given them, the expectation of the estimator is the mean of their
//               own f V / p
//   variance    that of f / p falls with M, down to that of the visibility and of what v
//               leaves out. One shadow ray at most, and more often one than without: a
//               sample that adds light is found more often
//   cost        per further candidate a light sample and an evaluation of the material
//   source      Talbot, Cline and Egbert 2005; reservoir: Chao 1982; steps: Roberts 2018
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

void BeginCandidates(Wave& wave) {
  ForEachBatch(wave, wave.queue(QueueId::kLit),
               [&](const StoreSlots& slots, MF) HWY_ATTR {
                 Scatter(hn::Zero(DF()), wave.path.candidate_weight_sum, slots);
               });
}

// Stores the kept sample as the light sample. If no candidate could add light, the last
// one stays, which carries none.
void KeepCandidate(Wave& wave) {
  const PathColumns& p = wave.path;
  const VF inverse_count = Splat(1.0f / static_cast<float>(wave.run->candidates));
  ForEachBatch(
      wave, wave.queue(QueueId::kLit), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const VF sum = Gather(p.candidate_weight_sum, slots);
        const MF any = hn::Gt(sum, hn::Zero(DF()));
        const auto put = [&](const float* kept, float* out) HWY_ATTR {
          Scatter(hn::IfThenElse(any, Gather(kept, slots), Gather(out, slots)), out,
                  slots);
        };
        const VF worth =
            hn::IfThenElse(any, Gather(p.candidate_weight, slots), Splat(1.0f));
        const VF factor = hn::Div(hn::Mul(sum, inverse_count), worth);
        const V3 light = Mul(Gather3(p.kept_r, p.kept_g, p.kept_b, slots), factor);
        Scatter3(IfThenElseZero(any, light), p.ls_r, p.ls_g, p.ls_b, slots);
        put(p.kept_x, p.ls_x), put(p.kept_y, p.ls_y), put(p.kept_z, p.ls_z);
        put(p.kept_distance, p.ls_distance);
        put(p.kept_pdf, p.ls_pdf);
        if (p.ls_light == nullptr) return;  // the scene has one light
        put(reinterpret_cast<const float*>(p.kept_light),
            reinterpret_cast<float*>(p.ls_light));
      });
}

Stage BeginCandidatesStage() {
  return {.name = "light_candidates",
          .meaning = "clears the weights of light candidates",
          .input = QueueId::kLit,
          .role = StageRole::kResample,
          .needs = {Feature::kLightCandidates, Feature::kLights, Feature::kScatters},
          .writes = {Field::candidate_weight_sum},
          .resolve = Always<BeginCandidates>};
}

Stage KeepCandidateStage() {
  return {.name = "light_keep",
          .meaning = "makes the kept candidate the light sample",
          .input = QueueId::kLit,
          .role = StageRole::kResample,
          .needs = {Feature::kLightCandidates, Feature::kLights, Feature::kScatters},
          .reads = fields::kKeptSample | fields::kLightSample |
                   FieldSet{Field::candidate_weight_sum, Field::ls_light},
          .writes = fields::kLightSample | FieldSet{Field::ls_light},
          .resolve = Always<KeepCandidate>};
}

LANELIGHT_END_KERNELS
