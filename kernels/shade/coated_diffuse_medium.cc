#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_diffuse_medium.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedDiffuseMedium(const FeatureSet& features) {
  return ResolveShade<CoatedDiffuseMediumBsdf, ShadeKind::kCoatedDiffuseMedium>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedDiffuseMedium);

Stage ShadeCoatedDiffuseMediumStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_medium", "scattering coat over a diffuse base",
      ShadeKind::kCoatedDiffuseMedium, [](const FeatureSet& features) {
        return HWY_DYNAMIC_DISPATCH(ResolveCoatedDiffuseMedium)(features);
      });
}

}  // namespace lanelight
#endif
