// What the roulettes on scattered rays have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

inline Stage RouletteStage(const char* name, const char* meaning, Feature kind,
                           StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kScattered,
          .needs = {Feature::kRoulette, kind},
          .reads = fields::kThroughput | FieldSet{Field::eta_scale, Field::depth,
                                                  Field::u_roulette, Field::reuse},
          .writes = fields::kThroughput,
          .resolve = resolve};
}

}  // namespace lanelight
