#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeThinDielectricStage() {
  return MakeShadeStage("shade_thin_dielectric", "thin sheet of glass",
                        ShadeKind::kThinDielectric,
                        ResolveShade<ThinDielectricBsdf, ShadeKind::kThinDielectric>);
}

LANELIGHT_END_KERNELS
