#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeCoatedDiffuseMediumStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_medium", "scattering coat over a diffuse base",
      ShadeKind::kCoatedDiffuseMedium,
      ResolveShade<CoatedDiffuseMediumBsdf, ShadeKind::kCoatedDiffuseMedium>);
}

LANELIGHT_END_KERNELS
