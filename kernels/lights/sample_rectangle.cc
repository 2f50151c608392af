// Light samples on emitting rectangles: by area, solid angle or that and the cosine at
// the receiver, as sample_triangle.cc says.
//   variance    nothing is spent on a choice between the halves, so the strata of
//               sample points stay whole
//   cost        by solid angle, two arctangents and a sine more; of the warp, as much as
//               for triangles
//   source      Urena, Fajardo and King 2013 (kernels/warp/spherical_rectangle-inl.h)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/sample_flat-inl.h"

LANELIGHT_BEGIN_KERNELS

// The data of a batch's lights that a sample needs.
struct RectangleEmitters {
  LightRectangle rectangle;
  V3 radiance;
  VF pmf, area;
  MF two_sided;

  HWY_INLINE RectangleEmitters(const Lights& light, VF selection)
      : rectangle(light),
        radiance(light.Radiance()),
        pmf(selection),
        area(light.Area()),
        two_sided(light.TwoSided()) {}

  HWY_INLINE V3 normal() const { return rectangle.n; }
  HWY_INLINE MF TwoSided() const { return two_sided; }
  HWY_INLINE SeenRectangle SeenFrom(V3 p) const { return {rectangle, p}; }
  HWY_INLINE V3 ByArea(VF u0, VF u1) const {
    return rectangle.At(hn::Mul(u0, rectangle.size_x), hn::Mul(u1, rectangle.size_y));
  }
};

struct RectangleSampling {
  template <bool kMany, LightPoints kPoints>
  static void Sample(Wave& wave) {
    const PathColumns& p = wave.path;
    ForEachLit<kMany>(wave, LightShape::kRectangle,
                      [&](const StoreSlots& slots, VI index) HWY_ATTR {
                        const Lights light(wave, index);
                        SampleFlatLight<kPoints>(
                            p, slots, RectangleEmitters(light, Pmf(wave, slots, index)));
                      });
  }
};

Stage SampleRectangleLightStage() {
  return SampleLightStage("light_rectangle", "samples emitting rectangles",
                          Feature::kRectangleLights,
                          ResolveSampleFlat<RectangleSampling>);
}

LANELIGHT_END_KERNELS
