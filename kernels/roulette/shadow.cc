// shadow-roulette=contribution: a shadow ray is traced with probability
// s = min(1, max(floor, carried light / threshold of its pixel)).
//   estimator   sh V / s with probability s, else 0: E = sh V
//   density     of tracing: s, a function of the carried light and of the pixel's
//               threshold, from a training pass (src/scene/prepare/tables.h)
//   unbiased    s >= floor > 0; s is known before the ray is traced
//   variance    grows by E[sh^2 V (1/s - 1)] per ray. Survivors below the threshold
//               carry at most the threshold, so there are no fireflies
//   cost        a gather of three and a compaction per ray
//   source      Arvo and Kirk 1990; Veach 1997, section 10.4 (efficiency-optimised);
//               Shirley, Wang and Zimmerman 1996 (fewer rays to what is dim)
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE VF ShadowSurvival(const ShadowThreshold& pixel_threshold, VI pixel,
                             V3 carried) {
  const VI at = hn::Mul(pixel, hn::Set(DI(), 3));
  const float* inverse = pixel_threshold.inverse.data();
  const V3 ratio = Mul(carried, Gather3(inverse, inverse + 1, inverse + 2, at));
  // Squares may overflow to infinity, which survives.
  return hn::Min(hn::Max(hn::Sqrt(Dot(ratio, ratio)), Splat(pixel_threshold.floor)),
                 Splat(1.0f));
}

void ShadowRoulette(Wave& wave) {
  const PathColumns& p = wave.path;
  const ShadowThreshold& pixel_threshold = wave.run->tables->shadow_threshold;
  if (pixel_threshold.inverse.empty()) return;  // the training pass itself
  Queue& queue = wave.queue(QueueId::kShadow);
  Queue survivors = {queue.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF valid) HWY_ATTR {
    const V3 carried = Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
    const VF s = ShadowSurvival(pixel_threshold, Gather(p.pixel, slots), carried);
    const MF survives = hn::Lt(Gather(p.u_shadow, slots), s);
    Scatter3(Mul(carried, hn::Div(Splat(1.0f), s)), p.sh_r, p.sh_g, p.sh_b, slots);
    Push(survivors, slots, hn::And(valid, survives));
  });
  wave.rays_shadow -= queue.size - survivors.size;
  queue.size = survivors.size;
}

Stage ShadowRouletteStage() {
  return {.name = "roulette_shadow",
          .meaning = "Russian roulette on shadow rays",
          .input = QueueId::kShadow,
          .role = StageRole::kRoulette,
          .needs = {Feature::kContributionShadowRoulette, Feature::kLights,
                    Feature::kScatters},
          .reads = fields::kShadow | FieldSet{Field::pixel, Field::u_shadow},
          .writes = fields::kShadow,
          .resolve = Always<ShadowRoulette>};
}

LANELIGHT_END_KERNELS
