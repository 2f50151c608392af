#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/diffuse_in_sphere.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDiffuseInSphere(const FeatureSet& features) {
  return ResolveShade<DiffuseInSphereBsdf, ShadeKind::kDiffuseInSphere>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDiffuseInSphere);

Stage ShadeDiffuseInSphereStage() {
  return MakeShadeStage("shade_diffuse_in_sphere",
                        "diffuse, density proportional to cos^3",
                        ShadeKind::kDiffuseInSphere, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDiffuseInSphere)(features);
                        });
}

}  // namespace lanelight
#endif
