#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_conductor_medium.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedConductorMedium(const FeatureSet& features) {
  return ResolveShade<CoatedConductorMediumBsdf, ShadeKind::kCoatedConductorMedium>(
      features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedConductorMedium);

Stage ShadeCoatedConductorMediumStage() {
  return MakeShadeStage(
      "shade_coated_conductor_medium", "scattering coat over metal",
      ShadeKind::kCoatedConductorMedium, [](const FeatureSet& features) {
        return HWY_DYNAMIC_DISPATCH(ResolveCoatedConductorMedium)(features);
      });
}

}  // namespace lanelight
#endif
