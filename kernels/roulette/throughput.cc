// roulette=throughput: a path survives with probability q = min(1, max component of its
// throughput), the factor eta^2 of refractions undone.
//   estimator   survivor / q, zero otherwise: E = q * (x / q) = x (the paper's equation
//   8) unbiased    q > 0 wherever the path can still carry light variance    grows by
//   E[x^2] (1/q - 1) per decision; bounded weights: a survivor's
//               throughput is at least its maximum's, so never above 1 after division
//   from        the second scattering event on, as in pbrt-v4
//   source      Arvo and Kirk 1990, "Particle Transport and Image Synthesis"
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/roulette/throughput.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/simd/vec3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kRefraction>
void Throughput(Wave& wave) {
  const PathColumns& p = wave.path;
  Queue& queue = wave.queue(QueueId::kScattered);
  Queue survivors = {queue.items, 0};  // compacts in place: writes never pass reads
  ForEachBatch(wave, queue, [&](VI slots, MF valid) HWY_ATTR {
    const V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
    VF q = MaxComponent(beta);
    if constexpr (kRefraction) q = hn::Mul(q, Gather(p.eta_scale, slots));
    const MF eligible =
        hn::And(hn::Lt(q, Splat(1.0f)),
                hn::RebindMask(DF(), hn::Gt(Gather(p.depth, slots), hn::Set(DI(), 1))));
    q = hn::IfThenElse(eligible, q, Splat(1.0f));
    const MF survives = hn::Lt(Gather(p.u_roulette, slots), q);
    const V3 scaled = Mul(beta, hn::Div(Splat(1.0f), q));
    const V3 kept = IfThenElse(hn::And(survives, eligible), scaled, beta);
    Scatter3(kept, p.beta_r, p.beta_g, p.beta_b, slots);
    Push(survivors, slots, hn::And(valid, survives));
    Push(wave.queue(QueueId::kDone), slots, hn::AndNot(survives, valid));
  });
  queue.size = survivors.size;
}

void ThroughputPlain(Wave& wave) { Throughput<false>(wave); }
void ThroughputRefraction(Wave& wave) { Throughput<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/wavefront/stage.h"

namespace lanelight {

HWY_EXPORT(ThroughputPlain);
HWY_EXPORT(ThroughputRefraction);

Stage ThroughputRouletteStage() {
  return {
      "roulette_throughput",
      "Russian roulette on the throughput",
      QueueId::kScattered,
      {Feature::kRoulette},
      fields::kThroughput | FieldSet{Field::eta_scale, Field::depth, Field::u_roulette},
      fields::kThroughput,
      [](const FeatureSet& features) -> StageFn {
        return features.Has(Feature::kRefraction)
                   ? HWY_DYNAMIC_DISPATCH(ThroughputRefraction)
                   : HWY_DYNAMIC_DISPATCH(ThroughputPlain);
      }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
