// What every sampler's two stages have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

using ResolveFn = StageFn (*)(const FeatureSet&);

inline constexpr FieldSet kPointsCounter = {Field::pixel, Field::sample, Field::depth,
                                            Field::branch};

inline Stage PointsCameraStage(const char* name, Feature policy, ResolveFn resolve) {
  return {.name = name,
          .meaning = "sample points of the film and lens",
          .input = QueueId::kCamera,
          .needs = {policy},
          .reads = kPointsCounter,
          .writes = {Field::u_film_0, Field::u_film_1, Field::u_lens_0, Field::u_lens_1,
                     Field::u_medium_0, Field::u_medium_1},
          .resolve = resolve};
}

inline Stage PointsBounceStage(const char* name, Feature policy, ResolveFn resolve) {
  return {.name = name,
          .meaning = "sample points of a bounce",
          .input = QueueId::kVertex,
          .needs = {policy, Feature::kScatters},
          .reads = kPointsCounter,
          .writes = fields::kBouncePoints,
          .resolve = resolve};
}

}  // namespace lanelight
