#include "tests/kernels/probe/math_probe.h"

#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/fresnel-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

void RunFresnel(const FresnelBatch& batch) {
  const DF df;
  for (uint32_t i = 0; i < batch.n; i += static_cast<uint32_t>(hn::Lanes(df))) {
    const VF c = hn::LoadU(df, batch.cosine + i), eta = hn::LoadU(df, batch.eta + i);
    if (batch.k != nullptr) {
      const VF k = hn::LoadU(df, batch.k + i);
      hn::StoreU(FresnelConductor(c, eta, k), df, batch.reflectance + i);
      continue;
    }
    const Interface at = DielectricInterface(c, eta);
    hn::StoreU(at.reflectance, df, batch.reflectance + i);
    if (batch.cos_t != nullptr) hn::StoreU(at.cos_t, df, batch.cos_t + i);
  }
}

// Applies warp `id`: in u, out the point and its density.
void ApplyWarp(WarpId id, const WarpBatch& w) {
  const DF df;
  for (uint32_t i = 0; i < w.n; i += static_cast<uint32_t>(hn::Lanes(df))) {
    const VF u0 = hn::LoadU(df, w.u0 + i), u1 = hn::LoadU(df, w.u1 + i);
    V3 p = Splat3(0, 0, 0);
    VF pdf = u0;
    switch (id) {
      case WarpId::kDisk: {
        const V2 q = SampleDisk(u0, u1);
        p = {q.x, q.y, hn::Zero(df)};
        pdf = Splat(kInvPi);
        break;
      }
      case WarpId::kCosine:
        p = SampleCosineHemisphere(u0, u1);
        pdf = PdfCosineHemisphere(p.z);
        break;
      case WarpId::kUniformHemisphere:
        p = SampleUniformHemisphere(u0, u1);
        pdf = PdfUniformHemisphere();
        break;
      case WarpId::kInSphere:
        p = SampleInSphere(u0, u1);
        pdf = PdfInSphere(p.z);
        break;
    }
    hn::StoreU(p.x, df, w.x + i);
    hn::StoreU(p.y, df, w.y + i);
    hn::StoreU(p.z, df, w.z + i);
    hn::StoreU(pdf, df, w.pdf + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(RunFresnel);
HWY_EXPORT(ApplyWarp);

void ProbeFresnel(SimdTarget target, const FresnelBatch& batch) {
  LANELIGHT_ON(target, RunFresnel)(batch);
}

void ProbeWarp(SimdTarget target, WarpId id, const WarpBatch& batch) {
  LANELIGHT_ON(target, ApplyWarp)(id, batch);
}

}  // namespace lanelight
#endif  // HWY_ONCE
