#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/dielectric_rough.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDielectricRough(const FeatureSet& features) {
  return ResolveShade<DielectricRoughBsdf, ShadeKind::kDielectricRough>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDielectricRough);

Stage ShadeDielectricRoughStage() {
  return MakeShadeStage("shade_dielectric_rough", "rough glass",
                        ShadeKind::kDielectricRough, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDielectricRough)(features);
                        });
}

}  // namespace lanelight
#endif
