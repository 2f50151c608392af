#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/conductor_rough.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveConductorRough(const FeatureSet& features) {
  return ResolveShade<ConductorRoughBsdf, ShadeKind::kConductorRough>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveConductorRough);

Stage ShadeConductorRoughStage() {
  return MakeShadeStage("shade_conductor_rough", "rough metal",
                        ShadeKind::kConductorRough, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveConductorRough)(features);
                        });
}

}  // namespace lanelight
#endif
