#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/conductor-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

LANELIGHT_BEGIN_KERNELS

BsdfProbe ProbeInterface(ShadeKind kind) {
  switch (kind) {
    case ShadeKind::kConductorSmooth:
      return ProbeOf<ConductorSmoothBsdf>();
    case ShadeKind::kConductorRough:
      return ProbeOf<ConductorRoughBsdf>();
    case ShadeKind::kDielectricSmooth:
      return ProbeOf<DielectricSmoothBsdf>();
    case ShadeKind::kThinDielectric:
      return ProbeOf<ThinDielectricBsdf>();
    case ShadeKind::kDielectricRough:
      return ProbeOf<DielectricRoughBsdf>();
    default:
      return {};
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeInterface);

BsdfProbe InterfaceBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeInterface)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
