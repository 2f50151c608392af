// Light samples on emitting disks and rings: uniform over the area.
//   density     pdf_area = pmf / area; pdf_sa = pdf_area d^2 / |cos|
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/geometry-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SampleDiskLight(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachLit<kMany>(
      wave, LightShape::kDisk, [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const LightDisk disk(wave, light.Primitive());
        // r^2 is uniform between the squares of the radii.
        const VF inner2 = hn::Mul(disk.inner_radius, disk.inner_radius);
        const VF span = hn::NegMulAdd(disk.inner_radius, disk.inner_radius,
                                      hn::Mul(disk.radius, disk.radius));
        const VF r = hn::Sqrt(hn::MulAdd(Gather(p.u_light_0, slots), span, inner2));
        const auto [sine, cosine] = SinCos2Pi(Gather(p.u_light_1, slots));
        const V3 v_axis = Cross(disk.n, disk.u_axis);
        const V3 q = MulAdd(disk.u_axis, hn::Mul(r, cosine),
                            MulAdd(v_axis, hn::Mul(r, sine), disk.center));
        StoreSurfaceSample(p, slots,
                           {q, disk.n, hn::Div(Pmf(wave, slots, index), light.Area())},
                           {light.Radiance(), light.TwoSided()});
      });
}

Stage SampleDiskLightStage() {
  return SampleLightStage(
      "light_disk", "samples emitting disks", Feature::kDiskLights,
      ByFeature<Feature::kManyLights, SampleDiskLight<true>, SampleDiskLight<false>>);
}

LANELIGHT_END_KERNELS
