// The colour of an image as three planes, for what goes over all pixels of one at a time.
#pragma once

#include <array>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

/// Values of one channel, rows from the top.
using Plane = std::vector<float>;

/// Linear sRGB.
struct LinearImage {
  int width = 0, height = 0;
  std::array<Plane, 3> planes;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
};

/// The colour channels of an image, decoded if they are bytes; grey is three equal
/// planes. Throws InputError where the image has no colour.
LinearImage LinearOf(const Image& image);

}  // namespace lanelight
