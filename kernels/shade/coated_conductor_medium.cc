#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

StageFn ResolveCoatedConductorMedium(const FeatureSet& features) {
  return ResolveShade<CoatedConductorMediumBsdf, ShadeKind::kCoatedConductorMedium>(
      features);
}

Stage ShadeCoatedConductorMediumStage() {
  return MakeShadeStage("shade_coated_conductor_medium", "scattering coat over metal",
                        ShadeKind::kCoatedConductorMedium, ResolveCoatedConductorMedium);
}

LANELIGHT_END_KERNELS
