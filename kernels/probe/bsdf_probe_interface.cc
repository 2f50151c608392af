#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/probe/bsdf_probe_interface.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/bsdf/conductor-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeInterface);

BsdfProbe InterfaceBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeInterface)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
