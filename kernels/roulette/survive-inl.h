// The decision that the roulettes on scattered rays share. A policy is a struct with
//   static VF Survival(const Wave&, const Slots& slots, V3 beta)
// giving a probability above 0 (values of 1 and more: always survives).
//   estimator   survivor / s, zero otherwise: E = s (x / s) = x (the paper's equation 8,
//               with s = 1 - q)
//   unbiased    s > 0 wherever the path can still carry light
//   variance    grows by E[x^2] (1/s - 1) per decision; more efficient if the saved time
//               outweighs that
#ifndef LANELIGHT_ROULETTE_SURVIVE_INL_H_
#define LANELIGHT_ROULETTE_SURVIVE_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/block.h"

LANELIGHT_BEGIN_KERNELS

/// With reuse=block, the density with which a path finds its second vertex must be known
/// at any point (kernels/reuse/pairs.cc), so no roulette is played before it.
LANELIGHT_INLINE MF LeavesFirst(const PathColumns& p, const Slots& slots) {
  const VI first = hn::Set(DI(), static_cast<int32_t>(ReuseState::kFirst));
  return hn::RebindMask(DF(), hn::Eq(Gather(p.reuse, slots), first));
}

template <class Policy>
LANELIGHT_INLINE void PlayRoulette(Wave& wave) {
  const PathColumns& p = wave.path;
  const VI before = hn::Set(DI(), static_cast<int32_t>(wave.run->roulette.first) - 1);
  Queue& queue = wave.queue(QueueId::kScattered);
  Queue survivors = {queue.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, queue, [&](const StoreSlots& slots, MF valid) HWY_ATTR {
    const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
    VF s = Policy::Survival(wave, slots, beta);
    MF eligible = hn::And(hn::Lt(s, Splat(1.0f)),
                          hn::RebindMask(DF(), hn::Gt(Gather(p.depth, slots), before)));
    if (p.reuse != nullptr) eligible = hn::AndNot(LeavesFirst(p, slots), eligible);
    LL_DCHECK(AllUnder(hn::And(valid, eligible), hn::Gt(s, hn::Zero(DF()))));
    s = hn::IfThenElse(eligible, s, Splat(1.0f));
    const MF survives = hn::Lt(Gather(p.u_roulette, slots), s);
    const V3 scaled = Mul(beta, hn::Div(Splat(1.0f), s));
    const V3 kept = IfThenElse(hn::And(survives, eligible), scaled, beta);
    Scatter3(kept, p.beta_r, p.beta_g, p.beta_b, slots);
    Push(survivors, slots, hn::And(valid, survives));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(survives, valid));
  });
  queue.size = survivors.size;
}

/// Undoes the factor eta^2 of refractions: radiance spreads when it leaves a denser
/// medium and gathers again, which is independent of the path's contribution.
LANELIGHT_INLINE VF WithoutRefraction(const PathColumns& p, const Slots& slots, VF s) {
  return p.eta_scale != nullptr ? hn::Mul(s, Gather(p.eta_scale, slots)) : s;
}

/// The stage of a roulette on scattered rays.
template <class Policy>
Stage RouletteStage(const char* name, const char* meaning, Feature kind) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kScattered,
          .role = StageRole::kRoulette,
          .needs = {Feature::kRoulette, kind},
          .reads = fields::kThroughput | FieldSet{Field::eta_scale, Field::depth,
                                                  Field::u_roulette, Field::reuse},
          .writes = fields::kThroughput,
          .resolve = Always<PlayRoulette<Policy>>};
}

LANELIGHT_END_KERNELS

#endif
