// What the roulettes that split have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage WindowStage(const char* name, const char* meaning, Feature kind,
                         StageFn (*resolve)(const FeatureSet&)) {
  const FieldSet identity = {Field::pixel,  Field::sample, Field::depth,
                             Field::output, Field::branch, Field::budget};
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kVertex,
          .needs = {Feature::kSplitting, Feature::kScatters, kind},
          .reads = fields::kThroughput | fields::kRay | fields::kPoint | fields::kNormal |
                   identity | FieldSet{Field::eta_scale},
          .writes = fields::kThroughput | fields::kRadiance | fields::kControl | identity,
          .resolve = resolve};
}

}  // namespace lanelight
