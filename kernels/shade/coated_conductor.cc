#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_conductor.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedConductor(const FeatureSet& features) {
  return ResolveShade<CoatedConductorBsdf, ShadeKind::kCoatedConductor>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedConductor);

Stage ShadeCoatedConductorStage() {
  return MakeShadeStage("shade_coated_conductor", "dielectric coat over metal",
                        ShadeKind::kCoatedConductor, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveCoatedConductor)(features);
                        });
}

}  // namespace lanelight
#endif
