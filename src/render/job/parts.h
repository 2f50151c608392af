// How the pixels of a render are shared out among parts that know nothing of each other.
#pragma once

#include <vector>

#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// Part `index` of `count`, both from 1 on.
struct Part {
  int index = 1, count = 1;
};

/// Tiles of a part of the window: every pixel is in exactly one part. Tiles are dealt out
/// along a Z-order curve, so that any part has its share of each region, and are as small
/// as it takes for many of them, but not below `least_side` pixels. Throws InputError if
/// there are more parts than tiles.
std::vector<PixelRect> TilesOfPart(const PixelRect& window, const Part& part,
                                   int least_side = 1);

}  // namespace lanelight
