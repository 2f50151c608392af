#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/diffuse.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDiffuse(const FeatureSet& features) {
  return ResolveShade<DiffuseBsdf, ShadeKind::kDiffuse>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDiffuse);

Stage ShadeDiffuseStage() {
  return MakeShadeStage("shade_diffuse", "Lambertian reflection", ShadeKind::kDiffuse,
                        [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDiffuse)(features);
                        });
}

}  // namespace lanelight
#endif
