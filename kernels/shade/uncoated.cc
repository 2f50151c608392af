// Materials without a coat, and points in a medium.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/conductor-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/hair-inl.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/bsdf/measured-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDiffuseStage() {
  return ShadeStage<DiffuseBsdf, ShadeKind::kDiffuse>("shade_diffuse",
                                                      "Lambertian reflection");
}
Stage ShadeDiffuseUniformStage() {
  return ShadeStage<DiffuseUniformBsdf, ShadeKind::kDiffuseUniform>(
      "shade_diffuse_uniform", "diffuse, directions uniform over the hemisphere");
}
Stage ShadeDiffuseInSphereStage() {
  return ShadeStage<DiffuseInSphereBsdf, ShadeKind::kDiffuseInSphere>(
      "shade_diffuse_in_sphere", "diffuse, density proportional to cos^3");
}
Stage ShadeDiffuseTransmissionStage() {
  return ShadeStage<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>(
      "shade_diffuse_transmission", "diffuse reflection and transmission");
}

Stage ShadeConductorSmoothStage() {
  return ShadeStage<ConductorSmoothBsdf, ShadeKind::kConductorSmooth>(
      "shade_conductor_smooth", "smooth metal");
}
Stage ShadeConductorRoughStage() {
  return ShadeStage<ConductorRoughBsdf, ShadeKind::kConductorRough>(
      "shade_conductor_rough", "rough metal");
}

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

Stage ShadeHairStage() {
  return ShadeStage<HairBsdf, ShadeKind::kHair>("shade_hair",
                                                "scattering by fibres of hair");
}

Stage ShadeMeasuredStage() {
  return ShadeStage<MeasuredBsdf, ShadeKind::kMeasured>("shade_measured",
                                                        "measured reflectance");
}

Stage ShadeHenyeyGreensteinStage() {
  return ShadeStage<HenyeyGreensteinBsdf, ShadeKind::kHenyeyGreenstein>(
      "shade_henyey_greenstein", "phase function of Henyey and Greenstein");
}

LANELIGHT_END_KERNELS
