#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/thin_dielectric.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveThinDielectric(const FeatureSet& features) {
  return ResolveShade<ThinDielectricBsdf, ShadeKind::kThinDielectric>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveThinDielectric);

Stage ShadeThinDielectricStage() {
  return MakeShadeStage("shade_thin_dielectric", "thin sheet of glass",
                        ShadeKind::kThinDielectric, [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveThinDielectric)(features);
                        });
}

}  // namespace lanelight
#endif
