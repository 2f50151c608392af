// What the roulettes on scattered rays have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage RouletteStage(const char* name, const char* meaning, Feature kind,
                           StageFn (*resolve)(const FeatureSet&)) {
  return {
      name,
      meaning,
      QueueId::kScattered,
      {Feature::kRoulette, kind},
      fields::kThroughput | FieldSet{Field::eta_scale, Field::depth, Field::u_roulette},
      fields::kThroughput,
      resolve};
}

}  // namespace lanelight
