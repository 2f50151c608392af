#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDiffuseInSphereStage() {
  return MakeShadeStage("shade_diffuse_in_sphere",
                        "diffuse, density proportional to cos^3",
                        ShadeKind::kDiffuseInSphere,
                        ResolveShade<DiffuseInSphereBsdf, ShadeKind::kDiffuseInSphere>);
}

LANELIGHT_END_KERNELS
