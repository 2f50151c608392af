#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDiffuseUniformStage() {
  return MakeShadeStage("shade_diffuse_uniform",
                        "diffuse, directions uniform over the hemisphere",
                        ShadeKind::kDiffuseUniform,
                        ResolveShade<DiffuseUniformBsdf, ShadeKind::kDiffuseUniform>);
}

LANELIGHT_END_KERNELS
