#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/henyey_greenstein.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveHenyeyGreenstein(const FeatureSet& features) {
  return ResolveShade<HenyeyGreensteinBsdf, ShadeKind::kHenyeyGreenstein>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveHenyeyGreenstein);

Stage ShadeHenyeyGreensteinStage() {
  return MakeShadeStage("shade_henyey_greenstein",
                        "phase function of Henyey and Greenstein",
                        ShadeKind::kHenyeyGreenstein, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveHenyeyGreenstein)(features);
                        });
}

}  // namespace lanelight
#endif
