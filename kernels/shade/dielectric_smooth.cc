#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/dielectric_smooth.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveDielectricSmooth(const FeatureSet& features) {
  return ResolveShade<DielectricSmoothBsdf, ShadeKind::kDielectricSmooth>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveDielectricSmooth);

Stage ShadeDielectricSmoothStage() {
  return MakeShadeStage("shade_dielectric_smooth", "smooth glass",
                        ShadeKind::kDielectricSmooth, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveDielectricSmooth)(features);
                        });
}

}  // namespace lanelight
#endif
