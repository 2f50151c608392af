// What the control stages on surfaces have in common: they run after the light samplers
// and before the shading stage of their material.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage SurfaceControlStage(const char* name, const char* meaning, Feature control,
                                 ShadeKind kind, StageFn (*resolve)(const FeatureSet&)) {
  using namespace fields;
  const FieldSet direction = {Field::d_x, Field::d_y, Field::d_z};
  return {name,
          meaning,
          ShadeQueue(kind),
          {control, ShadeFeature(kind), Feature::kScatters},
          direction | kThroughput | kRadiance | kPoint | kNormal | kParameters |
              kLightSample | kControl |
              FieldSet{Field::material, Field::ls_light, Field::guide_cell,
                       Field::kept_worth},
          kRadiance | kControl,
          resolve};
}

}  // namespace lanelight
