#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/diffuse_transmission.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDiffuseTransmission(const FeatureSet& features) {
  return ResolveShade<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDiffuseTransmission);

Stage ShadeDiffuseTransmissionStage() {
  return MakeShadeStage(
      "shade_diffuse_transmission", "diffuse reflection and transmission",
      ShadeKind::kDiffuseTransmission, [](const FeatureSet& features) {
        return HWY_DYNAMIC_DISPATCH(ResolveDiffuseTransmission)(features);
      });
}

}  // namespace lanelight
#endif
