#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDielectricRoughStage() {
  return MakeShadeStage("shade_dielectric_rough", "rough glass",
                        ShadeKind::kDielectricRough,
                        ResolveShade<DielectricRoughBsdf, ShadeKind::kDielectricRough>);
}

LANELIGHT_END_KERNELS
