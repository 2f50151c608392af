// Glass.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDielectricSmoothStage() {
  return ShadeStage<DielectricSmoothBsdf, ShadeKind::kDielectricSmooth>(
      "shade_dielectric_smooth", "smooth glass");
}
Stage ShadeDielectricRoughStage() {
  return ShadeStage<DielectricRoughBsdf, ShadeKind::kDielectricRough>(
      "shade_dielectric_rough", "rough glass");
}
Stage ShadeThinDielectricStage() {
  return ShadeStage<ThinDielectricBsdf, ShadeKind::kThinDielectric>(
      "shade_thin_dielectric", "thin sheet of glass");
}

LANELIGHT_END_KERNELS
