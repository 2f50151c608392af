// Metals.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/conductor-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeConductorSmoothStage() {
  return ShadeStage<ConductorSmoothBsdf, ShadeKind::kConductorSmooth>(
      "shade_conductor_smooth", "smooth metal");
}
Stage ShadeConductorRoughStage() {
  return ShadeStage<ConductorRoughBsdf, ShadeKind::kConductorRough>(
      "shade_conductor_rough", "rough metal");
}

LANELIGHT_END_KERNELS
