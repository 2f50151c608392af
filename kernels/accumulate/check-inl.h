// Finds samples that are not finite, or negative where they must not be.
#ifndef LANELIGHT_ACCUMULATE_CHECK_INL_H_
#define LANELIGHT_ACCUMULATE_CHECK_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// A sample; zero where it was bad.
struct Checked {
  V3 value;
  MF bad;
};

/// Counts bad samples of valid lanes. With kSigned, negative samples are good.
template <bool kSigned>
HWY_INLINE Checked Check(Health& counts, V3 v, MF valid) {
  const DF df;
  const auto any = [](MF x, MF y, MF z) HWY_ATTR { return hn::Or(x, hn::Or(y, z)); };
  const MF nan = any(hn::IsNaN(v.x), hn::IsNaN(v.y), hn::IsNaN(v.z));
  const MF infinite =
      hn::AndNot(nan, any(hn::IsInf(v.x), hn::IsInf(v.y), hn::IsInf(v.z)));
  MF bad = hn::Or(nan, infinite);
  if constexpr (!kSigned) {
    const VF zero = hn::Zero(df);
    const MF negative =
        hn::AndNot(bad, any(hn::Lt(v.x, zero), hn::Lt(v.y, zero), hn::Lt(v.z, zero)));
    counts.negative += hn::CountTrue(df, hn::And(negative, valid));
    bad = hn::Or(bad, negative);
  }
  counts.nan += hn::CountTrue(df, hn::And(nan, valid));
  counts.infinite += hn::CountTrue(df, hn::And(infinite, valid));
  const V3 zero = Splat3(0, 0, 0);
  return {IfThenElse(bad, zero, v), bad};
}

LANELIGHT_END_KERNELS

#endif
