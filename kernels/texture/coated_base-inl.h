// Conversions of texture colours: the colour below a coat, and the extinction of a metal.
#ifndef LANELIGHT_TEXTURE_COATED_BASE_INL_H_
#define LANELIGHT_TEXTURE_COATED_BASE_INL_H_

#include "kernels/texture/cube-inl.h"
#include "src/base/core/spectral_constants.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// k of a metal of index 1 with this reflectance r head-on: r = k^2 / (4 + k^2).
LANELIGHT_INLINE V3 MetalExtinction(V3 r) {
  const auto k = [](VF x) HWY_ATTR {
    const VF c = hn::Clamp(x, hn::Zero(DF()), Splat(0.9999f));
    return hn::Mul(Splat(2.0f), hn::Sqrt(hn::Div(c, hn::Sub(Splat(1.0f), c))));
  };
  return {k(r.x), k(r.y), k(r.z)};
}

/// Returns the colour that acts below a coat, by the table at `fit`
/// (src/scene/compile/coat.h). Components are clamped to [0, 1].
inline HWY_NOINLINE V3 CoatedBaseColor(const float* fit, V3 color) {
  const VF zero = hn::Zero(DF()), one = Splat(1.0f);
  const V3 bounded = {hn::Clamp(color.x, zero, one), hn::Clamp(color.y, zero, one),
                      hn::Clamp(color.z, zero, one)};
  const V3 at = Mul(bounded, Splat(kCoatFitNodes - 1.0f));
  const V3 c = AddOfCube<kCoatFitNodes>(fit, at, bounded);
  return {hn::Max(c.x, zero), hn::Max(c.y, zero), hn::Max(c.z, zero)};
}

LANELIGHT_END_KERNELS

#endif
