#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeHenyeyGreensteinStage() {
  return MakeShadeStage("shade_henyey_greenstein",
                        "phase function of Henyey and Greenstein",
                        ShadeKind::kHenyeyGreenstein,
                        ResolveShade<HenyeyGreensteinBsdf, ShadeKind::kHenyeyGreenstein>);
}

LANELIGHT_END_KERNELS
