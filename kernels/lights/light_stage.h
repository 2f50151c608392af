// What the light-sampling stages have in common.
#pragma once

#include "src/wavefront/stage.h"

namespace lanelight {

inline Stage SampleLightStage(const char* name, const char* meaning, Feature shape,
                              StageFn (*resolve)(const FeatureSet&)) {
  return {name,
          meaning,
          QueueId::kLit,
          {shape, Feature::kLights, Feature::kScatters},
          fields::kPoint | FieldSet{Field::u_light_0, Field::u_light_1, Field::ls_light},
          fields::kLightSample,
          resolve};
}

inline Stage EmissionStage(const char* name, const char* meaning, Feature shape,
                           StageFn (*resolve)(const FeatureSet&)) {
  return {name,
          meaning,
          QueueId::kHit,
          {shape},
          fields::kRay | fields::kHit | fields::kThroughput | fields::kRadiance |
              FieldSet{Field::bsdf_pdf},
          fields::kRadiance,
          resolve};
}

}  // namespace lanelight
