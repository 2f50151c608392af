// What a shadow ray must add to be traced for certain, for shadow-roulette=contribution:
// estimated by a training pass (src/render/train/train_shadow_worth.cc). It steers
// probabilities and never enters the image.
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"

namespace lanelight {

class ImageGuess;  // src/scene/prepare/estimate_path_values.h

/// Read by the kernel. The root of the sum over the channels of the squares of what a ray
/// carries times `inverse`, at least `floor`, is the probability with which it is traced.
struct ShadowWorth {
  float floor = 0.1f;            // least probability, in (0, 1]
  AlignedVector<float> inverse;  // 3 per pixel of the full image; empty = all are traced
};

/// Tracing a ray that adds v to a pixel of colour I with probability s adds v^2 (1/s - 1)
/// to the variance of the sample and saves (1 - s) of the ray's cost t. Variance times
/// cost is least with s = v / worth, where
///   worth = sqrt(variance of a sample * t / cost of a sample)
/// (the efficiency-optimised roulette of Veach 1997, section 10.4, per ray). As relative
/// errors weigh it, with the same relative variance in all pixels,
///   worth_c = sqrt(I_c^2 + epsilon) * relative,   3 inverse_c^2 = 1 / worth_c^2
/// relative: sqrt(relative variance of a sample * t / cost of a sample); 0 = trace all.
/// exposure: factor from what rays carry to the colours that `image` was made of.
AlignedVector<float> InverseShadowWorth(const ImageGuess& image, std::uint32_t pixels,
                                        double relative, double exposure);

}  // namespace lanelight
