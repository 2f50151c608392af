#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeCoatedDiffuseRoughStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_rough", "rough coat over a diffuse base",
      ShadeKind::kCoatedDiffuseRough,
      ResolveShade<CoatedDiffuseRoughBsdf, ShadeKind::kCoatedDiffuseRough>);
}

LANELIGHT_END_KERNELS
