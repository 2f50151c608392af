#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeConductorRoughStage() {
  return MakeShadeStage("shade_conductor_rough", "rough metal",
                        ShadeKind::kConductorRough,
                        ResolveShade<ConductorRoughBsdf, ShadeKind::kConductorRough>);
}

LANELIGHT_END_KERNELS
