#include "src/scene/prepare/shadow_worth.h"

#include <cmath>

#include "src/scene/prepare/estimate_path_values.h"

namespace lanelight {

AlignedVector<float> InverseShadowWorth(const ImageGuess& image, std::uint32_t pixels,
                                        double relative, double exposure) {
  AlignedVector<float> inverse;
  if (image.black() || !(relative > 0)) return inverse;
  inverse.reserve(std::size_t{pixels} * 3);
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    for (int c = 0; c < 3; ++c) {
      const double weight = std::sqrt(image.ErrorWeight(pixel, c) / 3);
      inverse.push_back(static_cast<float>(weight * exposure / relative));
    }
  }
  return inverse;
}

}  // namespace lanelight
