// What the roulettes that split have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage WindowStage(const char* name, const char* meaning, Feature kind,
                         StageFn (*resolve)(const FeatureSet&)) {
  const FieldSet identity = {Field::pixel,  Field::sample, Field::depth,
                             Field::output, Field::branch, Field::budget};
  return {name,
          meaning,
          QueueId::kVertex,
          {Feature::kSplitting, Feature::kScatters, kind},
          fields::kThroughput | fields::kRay | fields::kPoint | fields::kNormal |
              identity | FieldSet{Field::eta_scale},
          fields::kThroughput | fields::kRadiance | fields::kControl | identity,
          resolve};
}

}  // namespace lanelight
