// Which channels of an image are its colour.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "src/base/image/image.h"

namespace lanelight {

/// Indices of R, G and B, or three times that of a grey channel: Y, or the only one.
/// Nothing where none is known to be that: A is how much there is of a colour, and beside
/// X or RY and BY Y is a part of one.
std::optional<std::array<int, 3>> ColorChannels(const Image& image);

/// A sample; one of a byte is decoded as sRGB.
double LinearValue(const Image& image, int x, int y, int channel);

/// For errors where there are none: what the image has, and what would do.
std::string NoColorChannels(const Image& image);

}  // namespace lanelight
