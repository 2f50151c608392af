// Measured reflectance.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/measured-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeMeasuredStage() {
  return ShadeStage<MeasuredBsdf, ShadeKind::kMeasured>("shade_measured",
                                                        "measured reflectance");
}

LANELIGHT_END_KERNELS
