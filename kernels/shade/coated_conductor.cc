#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeCoatedConductorStage() {
  return MakeShadeStage("shade_coated_conductor", "dielectric coat over metal",
                        ShadeKind::kCoatedConductor,
                        ResolveShade<CoatedConductorBsdf, ShadeKind::kCoatedConductor>);
}

LANELIGHT_END_KERNELS
