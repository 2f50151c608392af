#include "kernels/simd/each_target-inl.h"

#include "kernels/shade/shade_stage.h"
#include "kernels/bsdf/diffuse_transmission-inl.h"
#include "kernels/shade/shade-inl.h"

LANELIGHT_BEGIN_KERNELS

Stage ShadeDiffuseTransmissionStage() {
  return MakeShadeStage(
      "shade_diffuse_transmission", "diffuse reflection and transmission",
      ShadeKind::kDiffuseTransmission,
      ResolveShade<DiffuseTransmissionBsdf, ShadeKind::kDiffuseTransmission>);
}

LANELIGHT_END_KERNELS
