// Hair.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/hair-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeHairStage() {
  return ShadeStage<HairBsdf, ShadeKind::kHair>("shade_hair",
                                                "scattering by fibres of hair");
}

LANELIGHT_END_KERNELS
