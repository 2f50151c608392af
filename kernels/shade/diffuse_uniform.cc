#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/diffuse_uniform.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDiffuseUniform(const FeatureSet& features) {
  return ResolveShade<DiffuseUniformBsdf, ShadeKind::kDiffuseUniform>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDiffuseUniform);

Stage ShadeDiffuseUniformStage() {
  return MakeShadeStage("shade_diffuse_uniform",
                        "diffuse, directions uniform over the hemisphere",
                        ShadeKind::kDiffuseUniform, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDiffuseUniform)(features);
                        });
}

}  // namespace lanelight
#endif
