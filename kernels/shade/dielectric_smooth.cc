#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDielectricSmoothStage() {
  return MakeShadeStage("shade_dielectric_smooth", "smooth glass",
                        ShadeKind::kDielectricSmooth,
                        ResolveShade<DielectricSmoothBsdf, ShadeKind::kDielectricSmooth>);
}

LANELIGHT_END_KERNELS
