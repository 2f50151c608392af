// Points in a medium.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeHenyeyGreensteinStage() {
  return ShadeStage<HenyeyGreensteinBsdf, ShadeKind::kHenyeyGreenstein>(
      "shade_henyey_greenstein", "phase function of Henyey and Greenstein");
}

LANELIGHT_END_KERNELS
