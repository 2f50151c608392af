// Importance sampling of a separable pixel filter from a tabulated CDF of |f| per axis.
#ifndef LANELIGHT_GENERATE_FILTER_INL_H_
#define LANELIGHT_GENERATE_FILTER_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

/// Offset in [-radius, radius) distributed like the piecewise-constant |f|, and the sign
/// of f there. Monotone in u, so it keeps the stratification of the sample points.
HWY_INLINE VF SampleFilterAxis(const float* cdf, const float* signs, float radius, VF u,
                               VF* sign) {
  const DI di;
  VI bin = hn::Zero(di);
  for (int step = CompiledFilter::kSize / 2; step > 0; step /= 2) {
    const VI next = hn::Add(bin, hn::Set(di, step));
    const auto right = hn::RebindMask(di, hn::Le(Gather(cdf, next), u));
    bin = hn::IfThenElse(right, next, bin);
  }
  const VF low = Gather(cdf, bin), high = Gather(cdf + 1, bin);
  const VF width = hn::Sub(high, low);
  const VF inside = hn::IfThenElse(hn::Gt(width, Splat(0)),
                                   hn::Div(hn::Sub(u, low), width), Splat(0.5f));
  *sign = Gather(signs, bin);
  const VF position = hn::Add(hn::ConvertTo(DF(), bin), inside);
  const float bin_width = 2 * radius / CompiledFilter::kSize;
  return hn::MulAdd(position, Splat(bin_width), Splat(-radius));
}

LANELIGHT_END_KERNELS

#endif
