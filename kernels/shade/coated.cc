// Coats over a diffuse or metallic base.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeCoatedDiffuseSmoothStage() {
  return ShadeStage<CoatedDiffuseSmoothBsdf, ShadeKind::kCoatedDiffuseSmooth>(
      "shade_coated_diffuse_smooth", "smooth coat over a diffuse base");
}
Stage ShadeCoatedDiffuseRoughStage() {
  return ShadeStage<CoatedDiffuseRoughBsdf, ShadeKind::kCoatedDiffuseRough>(
      "shade_coated_diffuse_rough", "rough coat over a diffuse base");
}
Stage ShadeCoatedConductorStage() {
  return ShadeStage<CoatedConductorBsdf, ShadeKind::kCoatedConductor>(
      "shade_coated_conductor", "dielectric coat over metal");
}
Stage ShadeCoatedDiffuseMediumStage() {
  return ShadeStage<CoatedDiffuseMediumBsdf, ShadeKind::kCoatedDiffuseMedium>(
      "shade_coated_diffuse_medium", "scattering coat over a diffuse base");
}
Stage ShadeCoatedConductorMediumStage() {
  return ShadeStage<CoatedConductorMediumBsdf, ShadeKind::kCoatedConductorMedium>(
      "shade_coated_conductor_medium", "scattering coat over metal");
}

LANELIGHT_END_KERNELS
