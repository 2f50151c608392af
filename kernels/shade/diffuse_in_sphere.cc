#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/diffuse_in_sphere.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/shade/diffuse_bsdf-inl.h"
#include "kernels/shade/probe-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDiffuseInSphere(const FeatureSet& features) {
  return ResolveShade<DiffuseInSphereBsdf, ShadeKind::kDiffuseInSphere>(features);
}
BsdfProbe ProbeDiffuseInSphere() { return ProbeOf<DiffuseInSphereBsdf>(); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDiffuseInSphere);
HWY_EXPORT(ProbeDiffuseInSphere);

Stage ShadeDiffuseInSphereStage() {
  return MakeShadeStage("shade_diffuse_in_sphere",
                        "diffuse, density proportional to cos^3",
                        ShadeKind::kDiffuseInSphere, Feature::kDiffuseInSphere,
                        [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDiffuseInSphere)(features);
                        });
}

template <>
BsdfProbe MakeBsdfProbe<ShadeKind::kDiffuseInSphere>() {
  return HWY_DYNAMIC_DISPATCH(ProbeDiffuseInSphere)();
}

}  // namespace lanelight
#endif
