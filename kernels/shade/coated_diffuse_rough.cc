#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_diffuse_rough.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedDiffuseRough(const FeatureSet& features) {
  return ResolveShade<CoatedDiffuseRoughBsdf, ShadeKind::kCoatedDiffuseRough>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedDiffuseRough);

Stage ShadeCoatedDiffuseRoughStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_rough", "rough coat over a diffuse base",
      ShadeKind::kCoatedDiffuseRough, [](const FeatureSet& features) {
        return HWY_DYNAMIC_DISPATCH(ResolveCoatedDiffuseRough)(features);
      });
}

}  // namespace lanelight
#endif
