// What the control stages on surfaces have in common: they run after the light samplers
// and before the shading stage of their material.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage SurfaceControlStage(const char* name, const char* meaning, Feature control,
                                 ShadeKind kind, StageFn (*resolve)(const FeatureSet&)) {
  using namespace fields;
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  return {.name = name,
          .meaning = meaning,
          .input = ShadeQueue(kind),
          .needs = {control, ShadeFeature(kind), Feature::kScatters},
          .reads = direction | kThroughput | kRadiance | kPoint | kNormal | kParameters |
                   kLightSample | kControl |
                   FieldSet{Field::material, Field::ls_light, Field::guide_cell,
                            Field::kept_worth},
          .writes = kRadiance | kControl,
          .resolve = resolve};
}

}  // namespace lanelight
