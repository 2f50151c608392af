// Values of images that are no numbers: a few of them are no reason to refuse an image.
#pragma once

#include <cstddef>

#include "src/base/image/image.h"

namespace lanelight {

/// The replacement of an infinite value: the largest half-precision number, since most
/// infinities come from overflow of that type.
inline constexpr float kLargestHalf = 65504;

/// Sets values that are not a number to 0 and infinite ones to +-kLargestHalf. Returns
/// how many; images of bytes have none.
std::size_t ReplaceNotFinite(Image* image);

}  // namespace lanelight
