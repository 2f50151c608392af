// Look-ups in the images of lights, one image per lane.
#ifndef LANELIGHT_LIGHTS_LIGHT_IMAGE_INL_H_
#define LANELIGHT_LIGHTS_LIGHT_IMAGE_INL_H_

#include <cstddef>

#include "kernels/simd/records-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

/// (s, t) in [0, 1]^2 from the upper left corner. Texels beyond the edges are those on
/// them, whatever s and t are.
class LightImages : RecordWords<LightImage> {
 public:
  LANELIGHT_INLINE LightImages(const LightTable& table, VI image)
      : RecordWords(table.images.data(), image),
        texels_(table.texels.data()),
        first_(I(offsetof(LightImage, first))),
        width_(I(offsetof(LightImage, width))),
        height_(I(offsetof(LightImage, height))) {}

  /// `away` from the light as (dot(x_axis, away), ...).
  LANELIGHT_INLINE V3 ToLocal(V3 away) const {
    return {Dot(F3(offsetof(LightImage, x_axis)), away),
            Dot(F3(offsetof(LightImage, y_axis)), away),
            Dot(F3(offsetof(LightImage, z_axis)), away)};
  }

  LANELIGHT_INLINE V3 Nearest(VF s, VF t) const {
    return Texel(ToIndex(Scaled(s, width_)), ToIndex(Scaled(t, height_)));
  }

  LANELIGHT_INLINE V3 Bilinear(VF s, VF t) const {
    const VI one = hn::Set(DI(), 1);
    const VF x = hn::Sub(Scaled(s, width_), Splat(0.5f));
    const VF y = hn::Sub(Scaled(t, height_), Splat(0.5f));
    const VI i = ToIndex(hn::Floor(x)), j = ToIndex(hn::Floor(y));
    const VF right = hn::Sub(x, hn::Floor(x)), below = hn::Sub(y, hn::Floor(y));
    const VI next_i = hn::Add(i, one), next_j = hn::Add(j, one);
    const V3 top = Mix(Texel(i, j), Texel(next_i, j), right);
    return Mix(top, Mix(Texel(i, next_j), Texel(next_i, next_j), right), below);
  }

 private:
  // Far outside all is the same; this keeps integers in range.
  static LANELIGHT_INLINE VF Scaled(VF s, VI size) {
    return hn::Mul(hn::Min(hn::Max(s, Splat(-1.0f)), Splat(2.0f)),
                   hn::ConvertTo(DF(), size));
  }
  static LANELIGHT_INLINE VI ToIndex(VF x) { return hn::ConvertTo(DI(), x); }
  static LANELIGHT_INLINE V3 Mix(V3 a, V3 b, VF t) {
    return Mul(a, hn::Sub(Splat(1.0f), t)) + Mul(b, t);
  }
  LANELIGHT_INLINE V3 Texel(VI column, VI row) const {
    const VI zero = hn::Zero(DI()), one = hn::Set(DI(), 1);
    const VI x = hn::Min(hn::Max(column, zero), hn::Sub(width_, one));
    const VI y = hn::Min(hn::Max(row, zero), hn::Sub(height_, one));
    return Gather3(texels_, hn::Add(first_, hn::Add(hn::Mul(y, width_), x)));
  }

  const float* texels_;
  VI first_, width_, height_;
};

LANELIGHT_END_KERNELS

#endif
