// Divides the pixels of a render among independent parts.
#pragma once

#include <vector>

#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// Part `index` of `count`, both from 1 on.
struct Part {
  int index = 1, count = 1;
};

/// Returns the tiles of a part of the window; every pixel is in exactly one part. Tiles
/// are dealt along a Z-order curve, so that each part has its share of each region; they
/// are halved until there are many, down to `min_side` pixels. Throws InputError if
/// there are more parts than tiles.
std::vector<PixelRect> TilesOfPart(const PixelRect& window, const Part& part,
                                   int min_side = 1);

}  // namespace lanelight
