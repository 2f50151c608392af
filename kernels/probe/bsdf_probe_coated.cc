#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/probe/bsdf_probe_coated.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeCoated);

BsdfProbe CoatedBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeCoated)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
