// Light samples of goniometric and projection lights: point lights whose intensity is an
// image of the direction, looked up without interpolation as pbrt does. A delta
// direction, radiance I(w) / d^2.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_image-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/warp/sphere-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

struct Goniometric {
  static constexpr LightShape kShape = LightShape::kGoniometric;
  static HWY_INLINE bool IsIn(const LightTable& table) { return table.has_goniometric; }
  static HWY_INLINE V3 Intensity(const LightImages& image, V3 away) {
    VF s, t;
    OctahedralSquare(image.ToLocal(away), &s, &t);
    return image.Nearest(s, t);
  }
};

struct Projection {
  static constexpr LightShape kShape = LightShape::kProjection;
  static HWY_INLINE bool IsIn(const LightTable& table) { return table.has_projection; }
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

template <bool kMany, class Kind>
HWY_INLINE void SampleKind(Wave& wave) {
  const PathColumns& p = wave.path;
  const LightTable& table = *wave.lights;
  if (!Kind::IsIn(table)) return;
  ForEachLit<kMany>(wave, Kind::kShape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
    const Lights light(wave, index);
    const LightImages image(table, light.I(offsetof(LightRecord, image)));
    const V3 to_light =
        light.F3(offsetof(LightRecord, position)) - Gather3(p.p_x, p.p_y, p.p_z, slots);
    const VF d2 = Dot(to_light, to_light);
    const VF distance = hn::Sqrt(d2);
    const V3 direction = Mul(to_light, hn::Div(Splat(1.0f), distance));
    const V3 intensity = Mul(light.Radiance(), Kind::Intensity(image, -direction));
    const VF factor = hn::Div(Splat(1.0f), hn::Mul(d2, Pmf(wave, slots, index)));
    StoreLightSample(
        p, slots,
        {direction, distance, Mul(intensity, factor), Splat(0), hn::Gt(d2, Splat(0))});
  });
}

template <bool kMany>
void SampleImageLight(Wave& wave) {
  SampleKind<kMany, Goniometric>(wave);
  SampleKind<kMany, Projection>(wave);
}

Stage SampleImageLightStage() {
  return SampleLightStage(
      "light_image", "connects to goniometric and projection lights",
      Feature::kImageLights,
      ByFeature<Feature::kManyLights, SampleImageLight<true>, SampleImageLight<false>>);
}

LANELIGHT_END_KERNELS
