#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeConductorSmoothStage() {
  return MakeShadeStage("shade_conductor_smooth", "smooth metal",
                        ShadeKind::kConductorSmooth,
                        ResolveShade<ConductorSmoothBsdf, ShadeKind::kConductorSmooth>);
}

LANELIGHT_END_KERNELS
