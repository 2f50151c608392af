#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/conductor_smooth.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveConductorSmooth(const FeatureSet& features) {
  return ResolveShade<ConductorSmoothBsdf, ShadeKind::kConductorSmooth>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveConductorSmooth);

Stage ShadeConductorSmoothStage() {
  return MakeShadeStage("shade_conductor_smooth", "smooth metal",
                        ShadeKind::kConductorSmooth, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveConductorSmooth)(features);
                        });
}

}  // namespace lanelight
#endif
