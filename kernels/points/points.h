// What every sampler's two stages have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

using ResolveFn = StageFn (*)(const FeatureSet&);

inline const FieldSet kPointsCounter = {Field::pixel, Field::sample, Field::depth,
                                        Field::branch};

inline Stage PointsCameraStage(const char* name, Feature policy, ResolveFn resolve) {
  return {name,
          "sample points of the film and lens",
          QueueId::kCamera,
          {policy},
          kPointsCounter,
          {Field::u_film_0, Field::u_film_1, Field::u_lens_0, Field::u_lens_1,
           Field::u_medium_0, Field::u_medium_1},
          resolve};
}

inline Stage PointsBounceStage(const char* name, Feature policy, ResolveFn resolve) {
  return {name,
          "sample points of a bounce",
          QueueId::kVertex,
          {policy, Feature::kScatters},
          kPointsCounter,
          fields::kBouncePoints,
          resolve};
}

}  // namespace lanelight
