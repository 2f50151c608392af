// A step of a float kernel done in double precision, half a vector at a time.
#ifndef LANELIGHT_INTERSECT_DOUBLE_INL_H_
#define LANELIGHT_INTERSECT_DOUBLE_INL_H_

#include "kernels/simd/lanes-inl.h"

LANELIGHT_BEGIN_KERNELS

/// fn(tag of doubles, v...) of the promoted lanes, rounded to float once.
template <class D, class Fn, class... V>
LANELIGHT_INLINE hn::Vec<D> InDouble(D d, Fn&& fn, V... v) {
  const hn::Half<D> dh;
  const hn::Rebind<double, hn::Half<D>> dd;
  const auto upper = fn(dd, hn::PromoteTo(dd, hn::UpperHalf(dh, v))...);
  const auto lower = fn(dd, hn::PromoteTo(dd, hn::LowerHalf(dh, v))...);
  return hn::Combine(d, hn::DemoteTo(dh, upper), hn::DemoteTo(dh, lower));
}

LANELIGHT_END_KERNELS

#endif
