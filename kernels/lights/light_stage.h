// Declarations shared by the light-sampling stages.
#pragma once

#include "src/vocabulary/path/light_shapes.h"
#include "src/vocabulary/path/stage.h"

namespace lanelight {

/// Lights that a ray can hit are sampled only if the strategy wants it.
inline constexpr bool IsHittable(Feature shape) {
  return !LightsWith(kDeltaLight).Has(shape);
}

inline Stage SampleLightStage(const char* name, const char* meaning, Feature shape,
                              StageFn (*resolve)(const FeatureSet&)) {
  FeatureSet needs = {shape, Feature::kLights, Feature::kScatters};
  if (IsHittable(shape)) needs.Add(Feature::kSampledHittableLights);
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = needs,
          .reads = fields::kPoint | fields::kNormal |
                   FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::u_light_0,
                            Field::u_light_1, Field::ls_light, Field::light_pmf,
                            Field::light_row},
          .writes = fields::kLightSample,
          .resolve = resolve};
}

/// Multiplies samples of emitting shapes by what there is at their points.
inline Stage EmittedThereStage(const char* name, const char* meaning, Feature need,
                               StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kLit,
          .role = StageRole::kLight,
          .needs = {need, Feature::kSampledHittableLights, Feature::kLights,
                    Feature::kScatters},
          .reads = fields::kPoint | fields::kLightSample | FieldSet{Field::ls_light},
          .writes = fields::kLightSample,
          .resolve = resolve};
}

/// Reads light_pmf too where a tree selects lights and light_hit_tree has written it.
inline Stage EmissionStage(const char* name, const char* meaning, Feature shape,
                           StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kHit,
          .role = StageRole::kEmission,
          .needs = {shape},
          .reads = fields::kRay | fields::kHit | fields::kThroughput | fields::kRadiance |
                   fields::kStartNormal |
                   FieldSet{Field::bsdf_pdf, Field::passed, Field::wavelength,
                            Field::hit_weight, Field::light_row},
          .writes = fields::kRadiance,
          .resolve = resolve};
}

}  // namespace lanelight
