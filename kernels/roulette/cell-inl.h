// Brightness and risk of paths, which the training passes of path values
// (src/scene/prepare/tables.h) and roulettes share.
#ifndef LANELIGHT_ROULETTE_CELL_INL_H_
#define LANELIGHT_ROULETTE_CELL_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/queue/grid_cell-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/prepare/tables.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the brightness, by the weights of the channels of the image.
LANELIGHT_INLINE VF Brightness(const PathValues& values, V3 c) {
  return hn::MulAdd(
      c.x, Splat(values.channel[0]),
      hn::MulAdd(c.y, Splat(values.channel[1]), hn::Mul(c.z, Splat(values.channel[2]))));
}

/// Adds the increase that roulette on the throughput causes in the second moment of paths
/// that have gathered g at this throughput (training_records.cc has the formula).
LANELIGHT_INLINE void AddRisk(const PathColumns& p, const Slots& slots, VF throughput,
                              VF g) {
  const VF one = Splat(1.0f), risk = Gather(p.risk_0, slots);
  const VF weight = hn::Add(one, risk);
  // The throughput that a survivor of the decisions before would have.
  VF s = hn::Mul(throughput, weight);
  if (p.eta_scale != nullptr) s = hn::Mul(s, Gather(p.eta_scale, slots));
  const VI before = hn::Set(DI(), kThroughputFirst - 1);
  const MF late = hn::RebindMask(DF(), hn::Gt(Gather(p.depth, slots), before));
  s = hn::Min(hn::IfThenElse(late, s, one), one);
  const VF a = hn::Mul(weight, hn::Sub(hn::Div(one, s), one));
  const VF ag = hn::Mul(a, g);
  Scatter(hn::Add(risk, a), p.risk_0, slots);
  Scatter(hn::Add(Gather(p.risk_1, slots), ag), p.risk_1, slots);
  Scatter(hn::MulAdd(ag, g, Gather(p.risk_2, slots)), p.risk_2, slots);
}

LANELIGHT_END_KERNELS

#endif
