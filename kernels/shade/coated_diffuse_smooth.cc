#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeCoatedDiffuseSmoothStage() {
  return MakeShadeStage(
      "shade_coated_diffuse_smooth", "smooth coat over a diffuse base",
      ShadeKind::kCoatedDiffuseSmooth,
      ResolveShade<CoatedDiffuseSmoothBsdf, ShadeKind::kCoatedDiffuseSmooth>);
}

LANELIGHT_END_KERNELS
