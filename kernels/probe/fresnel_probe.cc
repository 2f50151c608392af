#include "kernels/probe/fresnel_probe.h"

#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/fresnel-inl.h"

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

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(RunFresnel);

void ProbeFresnel(SimdTarget target, const FresnelBatch& batch) {
  LANELIGHT_ON(target, RunFresnel)(batch);
}

}  // namespace lanelight
#endif  // HWY_ONCE
