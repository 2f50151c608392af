#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

LANELIGHT_BEGIN_KERNELS

BsdfProbe ProbeDiffuse(ShadeKind kind) {
  switch (kind) {
    case ShadeKind::kDiffuse:
      return ProbeOf<DiffuseBsdf>();
    case ShadeKind::kDiffuseUniform:
      return ProbeOf<DiffuseUniformBsdf>();
    case ShadeKind::kDiffuseInSphere:
      return ProbeOf<DiffuseInSphereBsdf>();
    case ShadeKind::kDiffuseTransmission:
      return ProbeOf<DiffuseTransmissionBsdf>();
    case ShadeKind::kHenyeyGreenstein:
      return ProbeOf<HenyeyGreensteinBsdf>();
    default:
      return {};
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeDiffuse);

BsdfProbe DiffuseBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeDiffuse)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
