// Materials that send the same light to all directions on a side.
#include "kernels/simd/each_target-inl.h"

#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
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

LANELIGHT_END_KERNELS
