// Light samples on emitting disks and rings: uniform over the area.
//   density     pdf_area = pmf / area; pdf_sa = pdf_area d^2 / |cos|
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/sample_disk.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void SampleDiskLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kDisk, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(*wave.scene, index);
        const LightDisk disk(*wave.scene, light.Primitive());
        // r^2 is uniform between the squares of the radii.
        const VF inner2 = hn::Mul(disk.inner_radius, disk.inner_radius);
        const VF span = hn::NegMulAdd(disk.inner_radius, disk.inner_radius,
                                      hn::Mul(disk.radius, disk.radius));
        const VF r = hn::Sqrt(hn::MulAdd(Gather(p.u_light_0, slots), span, inner2));
        const auto [sine, cosine] = SinCos2Pi(Gather(p.u_light_1, slots));
        const V3 v_axis = Cross(disk.n, disk.u_axis);
        const V3 q = MulAdd(disk.u_axis, hn::Mul(r, cosine),
                            MulAdd(v_axis, hn::Mul(r, sine), disk.center));
        StoreSurfaceSample(p, slots, q, disk.n,
                           hn::Div(light.Pmf(p, slots), light.Area()), light.Radiance(),
                           light.TwoSided());
      });
}

void SampleDiskLightOne(Wave& wave) { SampleDiskLight<false>(wave); }
void SampleDiskLightMany(Wave& wave) { SampleDiskLight<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(SampleDiskLightOne);
HWY_EXPORT(SampleDiskLightMany);

Stage SampleDiskLightStage() {
  return SampleLightStage("light_disk", "samples emitting disks", Feature::kDiskLights,
                          [](const FeatureSet& features) -> StageFn {
                            return features.Has(Feature::kManyLights)
                                       ? HWY_DYNAMIC_DISPATCH(SampleDiskLightMany)
                                       : HWY_DYNAMIC_DISPATCH(SampleDiskLightOne);
                          });
}

}  // namespace lanelight
#endif  // HWY_ONCE
