// Light samples of lights without extent: a single direction to each.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/intensity-inl.h"
#include "kernels/lights/light-inl.h"
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

// Radiance I s / d^2, s = SpotShare.
template <bool kStretched>
struct SpotLight {
  static constexpr LightShape kShape = LightShape::kSpot;
  static HWY_INLINE LightSample Sample(const Wave& wave, const Slots& slots,
                                       const Lights& light, VF pmf) {
    const WayToLight way(wave.path, slots, light);
    const VF smooth = SpotShare<kStretched>(wave, light, -way.direction);
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

// Radiance I(w) / d^2, I an image of the direction.
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
