// Colours that a material makes of a texture's: below a coat, and of a metal.
#ifndef LANELIGHT_TEXTURE_COATED_BASE_INL_H_
#define LANELIGHT_TEXTURE_COATED_BASE_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/compile/coat_fit.h"
#include "src/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// k of a metal of index 1 with this reflectance r head-on: r = k^2 / (4 + k^2).
LANELIGHT_INLINE V3 MetalExtinction(V3 r) {
  const auto k = [](VF x) HWY_ATTR {
    const VF c = hn::Clamp(x, hn::Zero(DF()), Splat(0.9999f));
    return hn::Mul(Splat(2.0f), hn::Sqrt(hn::Div(c, hn::Sub(Splat(1.0f), c))));
  };
  return {k(r.x), k(r.y), k(r.z)};
}

/// The colour as it acts below a coat, by the table at `fit` (src/compile/coat_fit.h).
/// Components are clamped to [0, 1].
inline HWY_NOINLINE V3 CoatedBaseColor(const float* fit, V3 color) {
  const DF df;
  const DI di;
  const VF zero = hn::Zero(df), one = Splat(1.0f);
  const VI last = hn::Set(di, kCoatFitNodes - 2);
  VI base = hn::Zero(di);
  VF part[3];
  int32_t stride[3] = {1, kCoatFitNodes, kCoatFitNodes * kCoatFitNodes};
  V3 c = {hn::Clamp(color.x, zero, one), hn::Clamp(color.y, zero, one),
          hn::Clamp(color.z, zero, one)};
  const VF channel[3] = {c.x, c.y, c.z};
  for (int i = 0; i < 3; ++i) {
    const VF at = hn::Mul(channel[i], Splat(kCoatFitNodes - 1.0f));
    const VI cell = hn::Min(hn::ConvertTo(di, at), last);
    part[i] = hn::Sub(at, hn::ConvertTo(df, cell));
    base = hn::Add(base, hn::Mul(cell, hn::Set(di, stride[i])));
  }
  // From corner to corner along the axis of the largest part first, the smallest last.
  const VF high = hn::Max(part[0], hn::Max(part[1], part[2]));
  const VF low = hn::Min(part[0], hn::Min(part[1], part[2]));
  const VF middle =
      hn::Max(hn::Min(part[0], part[1]), hn::Min(hn::Max(part[0], part[1]), part[2]));
  const auto axis_of = [&](VF value) HWY_ATTR {
    const VI second = hn::IfThenElse(hn::RebindMask(di, hn::Eq(part[1], value)),
                                     hn::Set(di, stride[1]), hn::Set(di, stride[2]));
    return hn::IfThenElse(hn::RebindMask(di, hn::Eq(part[0], value)),
                          hn::Set(di, stride[0]), second);
  };
  const VI all = hn::Add(base, hn::Set(di, stride[0] + stride[1] + stride[2]));
  const VI corner[4] = {base, hn::Add(base, axis_of(high)), hn::Sub(all, axis_of(low)),
                        all};
  const VF weight[4] = {hn::Sub(one, high), hn::Sub(high, middle), hn::Sub(middle, low),
                        low};
  for (int i = 0; i < 4; ++i) {
    c = MulAdd(Gather3(fit, corner[i]), weight[i], c);
  }
  return {hn::Max(c.x, zero), hn::Max(c.y, zero), hn::Max(c.z, zero)};
}

LANELIGHT_END_KERNELS

#endif
