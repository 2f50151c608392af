// points=independent: every coordinate is an independent uniform number.
//   estimator   mean of N independent samples; variance sigma^2 / N
//   unbiased    always
//   cost        one PCG-4D hash per point
#ifndef LANELIGHT_SAMPLERS_INDEPENDENT_INL_H_
#define LANELIGHT_SAMPLERS_INDEPENDENT_INL_H_

#include "kernels/samplers/group-inl.h"

LANELIGHT_BEGIN_KERNELS

struct IndependentSequence {
  static LANELIGHT_INLINE GroupIndex Group(const SamplerParameters&, VU sample) {
    return {sample, hn::Zero(DU())};
  }
  static LANELIGHT_INLINE void Point(const PointKey& of, VF* u0, VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const U4 r = Pcg4d({pixel, at.group, key, seed});
    *u0 = ToUnit(r.x);
    *u1 = ToUnit(r.y);
  }
};

LANELIGHT_END_KERNELS

#endif
