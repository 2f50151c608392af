#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/probe/bsdf_probe_diffuse.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/probe/bsdf_probe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ProbeDiffuse);

BsdfProbe DiffuseBsdfProbe(ShadeKind kind) {
  return HWY_DYNAMIC_DISPATCH(ProbeDiffuse)(kind);
}

}  // namespace lanelight
#endif  // HWY_ONCE
