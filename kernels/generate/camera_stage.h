// The declaration that all cameras share.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

/// A camera, present where the plan has `projection`.
inline Stage MakeCameraStage(const char* name, const char* meaning, Feature projection,
                             StageFn (*resolve)(const FeatureSet&)) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kCamera,
          .needs = {projection},
          .reads = {Field::pixel, Field::u_film_0, Field::u_film_1, Field::u_lens_0,
                    Field::u_lens_1},
          .writes = fields::kRay | fields::WithFirstValue() |
                    FieldSet{Field::weight, Field::medium},
          .resolve = resolve};
}

}  // namespace lanelight
