#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/shade/coated_conductor.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/shade/coated_conductor_bsdf-inl.h"
#include "kernels/shade/probe-inl.h"
#include "kernels/shade/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveCoatedConductor(const FeatureSet& features) {
  return ResolveShade<CoatedConductorBsdf, ShadeKind::kCoatedConductor>(features);
}
BsdfProbe ProbeCoatedConductor() { return ProbeOf<CoatedConductorBsdf>(); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(ResolveCoatedConductor);
HWY_EXPORT(ProbeCoatedConductor);

Stage ShadeCoatedConductorStage() {
  return MakeShadeStage("shade_coated_conductor", "dielectric coat over metal",
                        ShadeKind::kCoatedConductor, Feature::kCoatedConductor,
                        [](const FeatureSet& features) {
                          return HWY_DYNAMIC_DISPATCH(ResolveCoatedConductor)(features);
                        });
}

template <>
BsdfProbe MakeBsdfProbe<ShadeKind::kCoatedConductor>() {
  return HWY_DYNAMIC_DISPATCH(ProbeCoatedConductor)();
}

}  // namespace lanelight
#endif
