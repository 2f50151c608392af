// What the stages of media have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

/// A stage that finds out what happens to rays on their way through media of a kind.
inline Stage MediumEventStage(const char* name, const char* meaning, Feature kind,
                              StageFn (*resolve)(const FeatureSet&)) {
  const FieldSet ray = {Field::medium, Field::u_medium_0, Field::u_medium_1,
                        Field::passed, Field::crossings,  Field::odds_r,
                        Field::odds_g, Field::odds_b,     Field::depth};
  const FieldSet odds = {Field::u_medium_0, Field::u_medium_1, Field::odds_r,
                         Field::odds_g, Field::odds_b};
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kActive,
          .needs = {Feature::kMedia, kind},
          .reads = fields::kRay | fields::kThroughput | fields::kRadiance | ray |
                   FieldSet{Field::t, Field::prim, Field::pixel, Field::sample,
                            Field::depth, Field::branch},
          .writes = fields::kThroughput | fields::kRadiance | odds | fields::kPoint |
                    fields::kNormal | FieldSet{Field::t, Field::prim, Field::material},
          .resolve = resolve};
}

}  // namespace lanelight
