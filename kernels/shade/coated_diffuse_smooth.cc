#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_diffuse_smooth.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedDiffuseSmooth(const FeatureSet& features) {
  return ResolveShade<CoatedDiffuseSmoothBsdf, ShadeKind::kCoatedDiffuseSmooth>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedDiffuseSmooth);

Stage ShadeCoatedDiffuseSmoothStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_smooth", "smooth coat over a diffuse base",
      ShadeKind::kCoatedDiffuseSmooth, [](const FeatureSet& features) {
        return HWY_DYNAMIC_DISPATCH(ResolveCoatedDiffuseSmooth)(features);
      });
}

}  // namespace lanelight
#endif
