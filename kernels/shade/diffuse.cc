#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDiffuseStage() {
  return MakeShadeStage("shade_diffuse", "Lambertian reflection", ShadeKind::kDiffuse,
                        ResolveShade<DiffuseBsdf, ShadeKind::kDiffuse>);
}

LANELIGHT_END_KERNELS
