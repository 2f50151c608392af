// The shading stage of each kind of material.
#pragma once

#include <iterator>

#include "kernels/stages.h"
#include "src/vocabulary/path/shade_kinds.h"

namespace lanelight::test {

// In the order of ShadeKind.
inline constexpr StageOn kShadeStages[] = {ShadeDiffuseStage,
                                           ShadeDiffuseUniformStage,
                                           ShadeDiffuseInSphereStage,
                                           ShadeConductorSmoothStage,
                                           ShadeConductorRoughStage,
                                           ShadeDielectricSmoothStage,
                                           ShadeDielectricRoughStage,
                                           ShadeThinDielectricStage,
                                           ShadeCoatedDiffuseSmoothStage,
                                           ShadeCoatedDiffuseRoughStage,
                                           ShadeCoatedConductorStage,
                                           ShadeCoatedDiffuseMediumStage,
                                           ShadeCoatedConductorMediumStage,
                                           ShadeDiffuseTransmissionStage,
                                           ShadeMeasuredStage,
                                           ShadeHairStage,
                                           ShadeHenyeyGreensteinStage};
static_assert(std::size(kShadeStages) == kNumShadeKinds);

}  // namespace lanelight::test
