// Intensities of lights without extent that differ by direction.
#ifndef LANELIGHT_LIGHTS_INTENSITY_INL_H_
#define LANELIGHT_LIGHTS_INTENSITY_INL_H_

#include "kernels/lights/light_image-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the share of a spot's intensity in the unit direction `away` from it: falls
/// from 1 inside the falloff cone to 0 at the edge as a smooth step, as in pbrt-v4. For
/// stretched lights the angle to the axis is that before they are stretched.
template <bool kStretched>
HWY_INLINE VF SpotShare(const SceneParts& scene, const Lights& light, V3 away) {
  // 1 - cos of the angle to the axis: half the squared distance of the unit vectors.
  // Cosines would not tell cones below 0.02 degrees from nothing.
  V3 aside;
  if constexpr (kStretched) {
    const LightImages axes(*scene.lights, light.I(offsetof(LightRecord, image)));
    aside = Normalize(axes.ToLocal(away)) - Splat3(0, 0, 1);
  } else {
    aside = light.F3(offsetof(LightRecord, direction)) - away;
  }
  const VF versine = hn::Mul(Splat(0.5f), Dot(aside, aside));
  const VF edge = light.F(offsetof(LightRecord, versine_total));
  const VF width = hn::Sub(edge, light.F(offsetof(LightRecord, versine_falloff)));
  const VF inside = hn::Sub(edge, versine);
  // A cone without falloff (width 0) is a step.
  const VF x =
      hn::IfThenElse(hn::Gt(width, Splat(0)), hn::Div(inside, width),
                     hn::IfThenElse(hn::Gt(inside, Splat(0)), Splat(1.0f), Splat(0)));
  const VF s = hn::Min(hn::Max(x, Splat(0)), Splat(1.0f));
  return hn::Mul(hn::Mul(s, s), hn::NegMulAdd(Splat(2.0f), s, Splat(3.0f)));
}

// Goniometric and projection lights are point lights whose intensity is an image of the
// direction, looked up without interpolation as pbrt does.
struct Goniometric {
  static constexpr LightShape kShape = LightShape::kGoniometric;
  static HWY_INLINE V3 Intensity(const LightImages& image, V3 away) {
    VF s, t;
    OctahedralSquare(image.ToLocal(away), &s, &t);
    return image.Nearest(s, t);
  }
};

struct Projection {
  static constexpr LightShape kShape = LightShape::kProjection;
  // Dark beside the picture and, as in pbrt, within 0.06 degrees of the plane that the
  // light lies in.
  static HWY_INLINE V3 Intensity(const LightImages& image, V3 away) {
    const V3 local = image.ToLocal(away);
    const VF half = Splat(0.5f), inverse = hn::Div(half, local.z);
    const VF s = hn::MulAdd(local.x, inverse, half),
             t = hn::MulAdd(local.y, inverse, half);
    const auto inside = [](VF v) HWY_ATTR {
      return hn::And(hn::Ge(v, Splat(0)), hn::Le(v, Splat(1.0f)));
    };
    const MF lit = hn::And(hn::Ge(local.z, Splat(1e-3f)), hn::And(inside(s), inside(t)));
    return IfThenElseZero(lit, image.Nearest(s, t));
  }
};

LANELIGHT_END_KERNELS

#endif
