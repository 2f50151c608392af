// Light samples of a constant environment: uniform over the sphere of directions.
//   density     pdf_sa = pmf / (4 pi)
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void SampleInfiniteConstant(Wave& wave) {
  const PathColumns& p = wave.path;
  const float inv_four_pi = 0.0795774715459476679f;
  ForEachLit<kMany>(
      wave, LightShape::kInfiniteConstant,
      [&](const StoreSlots& slots, VI index) HWY_ATTR {
        const Lights light(wave, index);
        const VF z = hn::NegMulAdd(Splat(2.0f), Gather(p.u_light_0, slots), Splat(1.0f));
        const VF ring = hn::Sqrt(hn::Max(hn::NegMulAdd(z, z, Splat(1.0f)), Splat(0)));
        const auto [sine, cosine] = SinCos2Pi(Gather(p.u_light_1, slots));
        const VF pdf = hn::Mul(Pmf(wave, slots, index), Splat(inv_four_pi));
        StoreLightSample(p, slots,
                         {{hn::Mul(ring, cosine), hn::Mul(ring, sine), z},
                          Splat(std::numeric_limits<float>::infinity()),
                          Mul(light.Radiance(), hn::Div(Splat(1.0f), pdf)),
                          pdf,
                          hn::Gt(pdf, Splat(0))});
      });
}

Stage SampleInfiniteConstantStage() {
  return SampleLightStage("light_infinite_constant", "samples constant environments",
                          Feature::kInfiniteConstant,
                          ByFeature<Feature::kManyLights, SampleInfiniteConstant<true>,
                                    SampleInfiniteConstant<false>>);
}

LANELIGHT_END_KERNELS
