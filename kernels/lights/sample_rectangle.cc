// Light samples on emitting rectangles: uniform over the area, or over the solid angle
// (light-points=solid-angle) where that is not too small.
//   density     pdf_area = pmf / area, pdf_sa = pdf_area d^2 / |cos|; or
//               pdf_sa = pmf / omega
//   variance    nothing is spent on a choice between the halves, so the strata of
//               sample points stay whole. By solid angle no noise is left of the
//               distance and of the cosine at the light
//   cost        by solid angle, two arctangents and a sine more
//   source      Urena, Fajardo and King 2013 (kernels/warp/spherical_rectangle-inl.h)
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_rectangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/warp/spherical_rectangle-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kSolidAngle>
HWY_INLINE void SampleRectangle(const PathColumns& p, const StoreSlots& slots,
                                const Lights& light) {
  const LightRectangle rectangle(light);
  const VF u0 = Gather(p.u_light_0, slots), u1 = Gather(p.u_light_1, slots);
  RectanglePoint at = {hn::Mul(u0, rectangle.size_x), hn::Mul(u1, rectangle.size_y)};
  VF omega = Splat(0);
  if constexpr (kSolidAngle) {
    const LocalRectangle local = rectangle.From(Gather3(p.p_x, p.p_y, p.p_z, slots));
    omega = local.SolidAngle(rectangle.size_x, rectangle.size_y);
    const RectanglePoint seen = SampleSphericalRectangle(local, omega, u0, u1);
    at.x = hn::IfThenElse(BySolidAngle(omega), seen.x, at.x);
    at.y = hn::IfThenElse(BySolidAngle(omega), seen.y, at.y);
  }
  const V3 q =
      MulAdd(rectangle.along_x, at.x, MulAdd(rectangle.along_y, at.y, rectangle.corner));
  const ShadowRay ray(p, slots, q, rectangle.n);
  const VF pmf = light.Pmf(p, slots);
  VF pdf_sa = ray.PdfSa(hn::Div(pmf, light.Area()));
  if constexpr (kSolidAngle) {
    pdf_sa = hn::IfThenElse(BySolidAngle(omega), hn::Div(pmf, omega), pdf_sa);
  }
  StoreShadowRay(p, slots, ray, pdf_sa, light.Radiance(), light.TwoSided());
}

template <bool kMany, bool kSolidAngle>
void SampleRectangleLight(Wave& wave) {
  ForEachLit<kMany>(
      wave, LightShape::kRectangle, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        SampleRectangle<kSolidAngle>(wave.path, slots, Lights(*wave.scene, index));
      });
}

void SampleRectangleAreaOne(Wave& wave) { SampleRectangleLight<false, false>(wave); }
void SampleRectangleAreaMany(Wave& wave) { SampleRectangleLight<true, false>(wave); }
void SampleRectangleAngleOne(Wave& wave) { SampleRectangleLight<false, true>(wave); }
void SampleRectangleAngleMany(Wave& wave) { SampleRectangleLight<true, true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleRectangleAreaOne);
HWY_EXPORT(SampleRectangleAreaMany);
HWY_EXPORT(SampleRectangleAngleOne);
HWY_EXPORT(SampleRectangleAngleMany);

Stage SampleRectangleLightStage() {
  return SampleLightStage("light_rectangle", "samples emitting rectangles",
                          Feature::kRectangleLights,
                          [](const FeatureSet& features) -> StageFn {
                            const bool many = features.Has(Feature::kManyLights);
                            if (features.Has(Feature::kSolidAngleLights)) {
                              return many ? HWY_DYNAMIC_DISPATCH(SampleRectangleAngleMany)
                                          : HWY_DYNAMIC_DISPATCH(SampleRectangleAngleOne);
                            }
                            return many ? HWY_DYNAMIC_DISPATCH(SampleRectangleAreaMany)
                                        : HWY_DYNAMIC_DISPATCH(SampleRectangleAreaOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
