// Light samples of lights without extent: a single direction to each.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_image-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

// The way from the vertices of paths to the positions of lights.
struct WayToLight {
  VF d2, distance;
  V3 direction;

  HWY_INLINE WayToLight(const PathColumns& p, const Slots& slots, const Lights& light) {
    const V3 to_light =
        light.F3(offsetof(LightRecord, position)) - Gather3(p.p_x, p.p_y, p.p_z, slots);
    d2 = Dot(to_light, to_light);
    distance = hn::Sqrt(d2);
    direction = Mul(to_light, hn::Div(Splat(1.0f), distance));
  }
};

// A kind has the sample for lights of a batch, which are chosen with `pmf`.
template <class Kind, bool kMany>
void SampleDelta(Wave& wave) {
  ForEachLit<kMany>(wave, Kind::kShape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
    StoreLightSample(
        wave.path, slots,
        Kind::Sample(wave, slots, Lights(wave, index), Pmf(wave, slots, index)));
  });
}

struct DistantLight {
  static constexpr LightShape kShape = LightShape::kDistant;
  static HWY_INLINE LightSample Sample(const Wave&, const Slots&, const Lights& light,
                                       VF pmf) {
    return {light.F3(offsetof(LightRecord, direction)),
            Splat(std::numeric_limits<float>::infinity()),
            Mul(light.Radiance(), hn::Div(Splat(1.0f), pmf)), Splat(0),
            hn::Gt(pmf, Splat(0))};
  }
};

// Radiance I / d^2.
struct PointLight {
  static constexpr LightShape kShape = LightShape::kPoint;
  static HWY_INLINE LightSample Sample(const Wave& wave, const Slots& slots,
                                       const Lights& light, VF pmf) {
    const WayToLight way(wave.path, slots, light);
    const VF factor = hn::Div(Splat(1.0f), hn::Mul(way.d2, pmf));
    return {way.direction, way.distance, Mul(light.Radiance(), factor), Splat(0),
            hn::Gt(way.d2, Splat(0))};
  }
};

// Radiance I s(theta) / d^2, where s falls from 1 inside the falloff cone to 0 at the
// edge as a smooth step, as in pbrt-v4. For stretched lights theta is the angle before
// they are stretched.
template <bool kStretched>
struct SpotLight {
  static constexpr LightShape kShape = LightShape::kSpot;
  static HWY_INLINE LightSample Sample(const Wave& wave, const Slots& slots,
                                       const Lights& light, VF pmf) {
    const WayToLight way(wave.path, slots, light);
    // 1 - cos of the angle to the axis: half the squared distance of the unit vectors.
    // Cosines would not tell cones below 0.02 degrees from nothing.
    V3 aside;
    if constexpr (kStretched) {
      const LightImages axes(*wave.lights, light.I(offsetof(LightRecord, image)));
      aside = Normalize(axes.ToLocal(-way.direction)) - Splat3(0, 0, 1);
    } else {
      aside = way.direction + light.F3(offsetof(LightRecord, direction));
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
    const VF smooth = hn::Mul(hn::Mul(s, s), hn::NegMulAdd(Splat(2.0f), s, Splat(3.0f)));
    const VF factor = hn::Div(smooth, hn::Mul(way.d2, pmf));
    return {way.direction, way.distance, Mul(light.Radiance(), factor), Splat(0),
            hn::And(hn::Gt(way.d2, Splat(0)), hn::Gt(smooth, Splat(0)))};
  }
};

template <bool kMany>
void SampleSpotLight(Wave& wave) {
  if (wave.lights->stretched_spots) return SampleDelta<SpotLight<true>, kMany>(wave);
  SampleDelta<SpotLight<false>, kMany>(wave);
}

// Goniometric and projection lights are point lights whose intensity is an image of the
// direction, looked up without interpolation as pbrt does: radiance I(w) / d^2.
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

template <class Kind>
struct ImageLight {
  static constexpr LightShape kShape = Kind::kShape;
  static HWY_INLINE LightSample Sample(const Wave& wave, const Slots& slots,
                                       const Lights& light, VF pmf) {
    const LightImages image(*wave.lights, light.I(offsetof(LightRecord, image)));
    const WayToLight way(wave.path, slots, light);
    const V3 intensity = Mul(light.Radiance(), Kind::Intensity(image, -way.direction));
    const VF factor = hn::Div(Splat(1.0f), hn::Mul(way.d2, pmf));
    return {way.direction, way.distance, Mul(intensity, factor), Splat(0),
            hn::Gt(way.d2, Splat(0))};
  }
};

template <bool kMany>
void SampleImageLight(Wave& wave) {
  const LightTable& table = *wave.lights;
  if (table.has_goniometric) SampleDelta<ImageLight<Goniometric>, kMany>(wave);
  if (table.has_projection) SampleDelta<ImageLight<Projection>, kMany>(wave);
}

Stage SampleDistantLightStage() {
  return SampleLightStage("light_distant", "connects to distant lights",
                          Feature::kDistantLights,
                          ByFeature<Feature::kManyLights, SampleDelta<DistantLight, true>,
                                    SampleDelta<DistantLight, false>>);
}
Stage SamplePointLightStage() {
  return SampleLightStage("light_point", "connects to point lights",
                          Feature::kPointLights,
                          ByFeature<Feature::kManyLights, SampleDelta<PointLight, true>,
                                    SampleDelta<PointLight, false>>);
}
Stage SampleSpotLightStage() {
  return SampleLightStage(
      "light_spot", "connects to spot lights", Feature::kSpotLights,
      ByFeature<Feature::kManyLights, SampleSpotLight<true>, SampleSpotLight<false>>);
}
Stage SampleImageLightStage() {
  return SampleLightStage(
      "light_image", "connects to goniometric and projection lights",
      Feature::kImageLights,
      ByFeature<Feature::kManyLights, SampleImageLight<true>, SampleImageLight<false>>);
}

LANELIGHT_END_KERNELS
