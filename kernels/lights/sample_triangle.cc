// Light samples on emitting triangles: uniform over the area.
//   density     pdf_area = pmf / area; pdf_sa = pdf_area d^2 / |cos|
//   source      Turk 1990, "Generating Random Points in Triangles" (square-root warp)
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SampleTriangleLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kTriangle, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(*wave.scene, index);
        const LightTriangle triangle(*wave.scene, light.Primitive());
        const VF root = hn::Sqrt(Gather(p.u_light_0, slots));
        const VF b1 = hn::Sub(Splat(1.0f), root);
        const VF b2 = hn::Mul(root, Gather(p.u_light_1, slots));
        const V3 q = MulAdd(triangle.e1, b1, MulAdd(triangle.e2, b2, triangle.p0));
        StoreSurfaceSample(p, slots, q, triangle.n,
                           hn::Div(light.Pmf(p, slots), light.Area()), light.Radiance(),
                           light.TwoSided());
      });
}

void SampleTriangleLightOne(Wave& wave) { SampleTriangleLight<false>(wave); }
void SampleTriangleLightMany(Wave& wave) { SampleTriangleLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleTriangleLightOne);
HWY_EXPORT(SampleTriangleLightMany);

Stage SampleTriangleLightStage() {
  return SampleLightStage("light_triangle", "samples emitting triangles",
                          Feature::kTriangleLights,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SampleTriangleLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SampleTriangleLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
