#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

LANELIGHT_BEGIN_KERNELS

BsdfProbe ProbeCoated(ShadeKind kind) {
  switch (kind) {
    case ShadeKind::kCoatedDiffuseSmooth:
      return ProbeOf<CoatedDiffuseSmoothBsdf>();
    case ShadeKind::kCoatedDiffuseRough:
      return ProbeOf<CoatedDiffuseRoughBsdf>();
    case ShadeKind::kCoatedConductor:
      return ProbeOf<CoatedConductorBsdf>();
    case ShadeKind::kCoatedDiffuseMedium:
      return ProbeOf<CoatedDiffuseMediumBsdf>();
    case ShadeKind::kCoatedConductorMedium:
      return ProbeOf<CoatedConductorMediumBsdf>();
    default:
      return {};
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeCoated);

BsdfProbe CoatedBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeCoated)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
